// Which part of a structure sets its step.
#pragma once

#include <optional>
#include <string>

#include "sim/body/structure.h"
#include "sim/linear/stiffness.h"

namespace billow::sim {

/// The place where the fastest mode moves most, if the step would be much longer without it.
struct StepSetter {
  int particle = 0, neighbour = 0;  // of the shortest spring there
  double length = 0.0;              // [m] of that spring
  double mass = 0.0;                // [kg] of the particle
  double median_mass = 0.0;         // [kg] of all that are free
  double ratio = 1.0;               // of the step without its neighbourhood to the step with it
};

/// Nothing where no place makes the step less than half of what it would be without it and its neighbours. `stiffness`
/// is K at rest.
std::optional<StepSetter> find_step_setter(const Structure& structure, const StiffnessMatrix& stiffness);

/// As a sentence with what to do: "edge 1042-1043 of 'drape', 0.3 mm long, sets the step: ...".
std::string text_of(const Structure& structure, const StepSetter& setter);

}  // namespace billow::sim
