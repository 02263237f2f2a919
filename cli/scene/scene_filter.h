// The filter that a scene asks for, made for its structure.
#pragma once

#include <optional>

#include "cli/scene/scene.h"
#include "sim/body/structure.h"
#include "sim/filter/filter.h"
#include "sim/force/forces.h"

namespace billow::cli {

/// lambda evaluated at every particle, shares of levels found. None where the scene does not filter, and where levels
/// are to choose their own ratio and none is needed:
///
/// With a given step the weakest levels whose limit for any shape times `safety` is that step. Otherwise those for
/// steps of 0.008 s, but of no more than ten times the unfiltered step, beyond which levels slow what one
/// sees.
///
/// `structure` must outlive the filter. Throws InputError, located in the scene, also where no levels allow the step.
std::optional<sim::Filter> make_filter(const Scene& scene, const sim::Structure& structure, const sim::Forces& forces);

}  // namespace billow::cli
