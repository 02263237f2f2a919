// A scene that is being run, and what was decided before its first frame.
#pragma once

#include <string>

#include "cli/drawn/drawn_scene.h"
#include "cli/run/frame_list.h"
#include "cli/scene/scene.h"
#include "cli/scene/simulation.h"

namespace billow::cli {

struct Run {
  const Scene& scene;
  const Simulation& simulation;
  const DrawnScene& drawn;
  const StepChoice& choice;
  const std::string& command;  // as it was typed
};

/// Number of frames of a scene: those whose time lies before its duration.
long frame_count(const Scene& scene);

}  // namespace billow::cli
