// Pins of a scene as the simulation needs them: which particles are held when, and what moves them.
#pragma once

#include <vector>

#include "cli/scene/scene.h"
#include "sim/step/moving_pins.h"

namespace billow::cli {

/// The vertices that `pins` hold at `time` [s], ascending: one that several hold until the last lets go.
std::vector<int> held_vertices(const std::vector<PinSpec>& pins, double time);

/// When fewer particles of the scene are held from then on [s], ascending, all before its end.
std::vector<double> release_times(const Scene& scene);

/// `structure`, the scene's at its start, with what is let go by `time` [s] free.
sim::Structure released(const Scene& scene, sim::Structure structure, double time);

/// The pins that move and hold at `time` [s].
std::vector<sim::MovingPin> moving_pins(const Scene& scene, const sim::Structure& structure, double time);

}  // namespace billow::cli
