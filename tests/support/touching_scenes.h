// Scenes in which things touch in every way that contact must survive.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/force/forces.h"
#include "sim/step/moving_pins.h"
#include "sim/step/solver.h"
#include "tests/support/surface_crossings.h"

namespace billow::test {

/// What a run needs, whole. Immovable: the model refers to structure and options.
struct TouchingScene {
  TouchingScene() = default;
  TouchingScene(const TouchingScene&) = delete;
  TouchingScene& operator=(const TouchingScene&) = delete;

  std::string name;
  sim::Structure structure;
  sim::ContactOptions contact;
  Eigen::Vector3d gravity{0.0, -9.81, 0.0};  // [m/s^2]
  sim::State start;
  std::vector<sim::MovingPin> pins;
  double duration = 1.0;  // [s]
  double step = 0.001;    // [s] 0.9 of the certified limit for any shape
};

/// A cloth of `across` x `along` squares over the xz plane, `size` [m] across, its middle at `middle` [m].
sim::Mesh flat_sheet(int across, int along, double size, const Eigen::Vector3d& middle);

/// Adds a body, its springs `stiffness` [N/m] in the proportions of a default cloth, with friction enough to settle.
struct ClothInScene {
  sim::Mesh mesh;
  double mass = 0.1;         // [kg]
  double stiffness = 100.0;  // [N/m]
  double thickness = 0.004;  // [m]
  double friction = 0.3;     // Coulomb's
  double drag = 1e-4;        // [kg/s] of each particle
  std::vector<int> pinned = {};
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // [m/s]
};

/// The scene of these cloths; its step is found.
std::unique_ptr<TouchingScene> touching_scene(const std::string& name, const std::vector<ClothInScene>& cloths,
                                              std::vector<sim::Collider> colliders, double duration);

/// A run of a scene, and what of its surfaces crosses.
class TouchingRun {
 public:
  explicit TouchingRun(const TouchingScene& scene);

  /// The state at `time` [s] or the end of the step that reaches it.
  sim::State sample(double time) { return solver_->sample(time); }
  std::size_t crossings_at(const sim::State& state) const { return crossings_of(model_, state); }
  const sim::Solver& solver() const { return *solver_; }
  const sim::Forces& forces() const { return forces_; }
  const sim::Contact& contact() const { return *hook_; }

 private:
  const TouchingScene& scene_;
  sim::Forces forces_;
  sim::ContactModel model_;
  const sim::Contact* hook_ = nullptr;
  std::unique_ptr<sim::Solver> solver_;
};

/// All that nothing may pass through anything in.
std::vector<std::string> touching_scene_names();
std::unique_ptr<TouchingScene> touching_scene_named(const std::string& name);

}  // namespace billow::test
