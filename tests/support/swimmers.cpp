#include "tests/support/swimmers.h"

#include <numbers>

#include "sim/force/muscle_force.h"
#include "sim/force/water_force.h"

namespace billow::test {

sim::FishOptions swimmer_options(double length) {
  sim::FishOptions fish;
  const double s = length;
  fish.length = length;
  fish.mass = {0.3 * s * s * s, {}, 0.165 * s * s * s};
  const std::array<double, sim::fish_rings> ring{0.4, 0.56, 0.4, 0.4, 0.4};
  for (std::size_t r = 0; r < ring.size(); ++r) fish.mass.ring[r] = ring[r] * s * s * s;
  fish.cross *= s, fish.normal *= s, fish.muscle = 45.0 * s;
  fish.viscosity *= s * s;
  return fish;
}

sim::MotionOptions swimming(double frequency, double swim) {
  sim::MotionOptions motion;
  motion.keys = {{0.0, swim, 0.0, frequency}};
  motion.transition = 0.3;
  motion.lag = 93.0 * std::numbers::pi / 180.0;
  return motion;
}

sim::MotionOptions turning(double turn) {
  sim::MotionOptions motion = swimming();
  motion.keys.push_back({3.0, motion.keys[0].swim, turn, motion.keys[0].frequency});
  return motion;
}

Swimmer::Swimmer(const sim::MotionOptions& motion, const sim::FishOptions& options, double resistance)
    : structure(sim::build_fish(options)),
      forces(std::make_unique<sim::Forces>(structure, Eigen::Vector3d(Eigen::Vector3d::Zero()))) {
  forces->add(std::make_unique<sim::MuscleForce>(structure, 0, sim::FishMotion(motion)));
  forces->add(std::make_unique<sim::WaterForce>(structure, sim::Water{resistance, Eigen::Vector3d::Zero()},
                                                sim::fish_faces(), 0));
}

sim::State Swimmer::at(double time, sim::SolverOptions options) const {
  return sim::Solver(structure, *forces, options, sim::rest_state(structure)).sample(time);
}

sim::State Swimmer::at(double time) const {
  sim::SolverOptions options;
  options.step = 0.05;
  return at(time, options);
}

Eigen::Vector3d Swimmer::centre(const sim::State& state) const {
  return state.position.transpose() * structure.mass / structure.mass.sum();
}

Eigen::Vector3d Swimmer::heading(const sim::State& state) const {
  const Eigen::Vector3d snout = state.position.row(sim::fish_snout()).transpose();
  return (snout - centre(state)).normalized();
}

}  // namespace billow::test
