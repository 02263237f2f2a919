// What the watch saw, in words.
#pragma once

#include <string>
#include <string_view>

#include "sim/step/watched_run.h"

namespace billow::cli {

/// A sentence of when, why and at what cost; `step` [s] is the whole one. While it still goes on its end is unknown.
std::string incident_text(const sim::Incident& incident, double step);

/// As run.json writes it: "energy", "divergence", "unexplained".
std::string_view name(sim::Incident::Kind kind);

}  // namespace billow::cli
