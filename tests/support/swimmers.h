// Fish in water for tests: the one that scenes/fish.yaml shows, with whatever its muscles are told to do.
#pragma once

#include <memory>
#include <vector>

#include "sim/body/fish.h"
#include "sim/body/fish_motion.h"
#include "sim/force/forces.h"
#include "sim/step/solver.h"

namespace billow::test {

/// The fish of scenes/fish.yaml, `length` [m] long: its numbers go with the length as sim::fish_of_length's do.
sim::FishOptions swimmer_options(double length = 1.0);
/// The motion of scenes/fish.yaml at another frequency [1/s] and amplitude.
sim::MotionOptions swimming(double frequency = 1.34, double swim = 0.71);
/// Swims from the start and turns by `turn` from 3 s on.
sim::MotionOptions turning(double turn);

/// A fish and its forces: springs, muscles, water; no gravity.
struct Swimmer {
  explicit Swimmer(const sim::MotionOptions& motion, const sim::FishOptions& options = swimmer_options(),
                   double resistance = 580.0);

  /// The state at `time` [s] of a run from rest.
  sim::State at(double time, sim::SolverOptions options) const;
  sim::State at(double time) const;
  /// Centre of mass [m], and the direction from it to the snout (unit).
  Eigen::Vector3d centre(const sim::State& state) const;
  Eigen::Vector3d heading(const sim::State& state) const;
  /// How far the centre of mass has come [m].
  Eigen::Vector3d way(const sim::State& state) const { return centre(state) - centre(sim::rest_state(structure)); }

  sim::Structure structure;
  std::unique_ptr<sim::Forces> forces;
};

}  // namespace billow::test
