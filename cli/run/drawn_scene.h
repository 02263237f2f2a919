// What is drawn of a simulation: its bodies' skins, what they collide with, and the specks in the water around them.
#pragma once

#include <optional>
#include <vector>

#include "cli/run/drawn_collider.h"
#include "cli/run/motes.h"
#include "cli/scene/simulation.h"
#include "render/frame/mesh_renderer.h"
#include "sim/drawn/skin.h"

namespace billow::cli {

class DrawnScene {
 public:
  /// Both must outlive this.
  DrawnScene(const Scene& scene, const Simulation& simulation);

  /// The drawn bodies, textures included, then the colliders; motes, where the water has any, come last.
  std::vector<render::DrawnBody> bodies() const;
  /// Where all of those are at `state`, as the camera sees it: moved along with the body that it follows.
  std::vector<sim::SurfaceState> surfaces(const sim::State& state) const;
  /// Of that camera [m/s].
  Eigen::Vector3d camera_velocity(const sim::State& state) const;
  /// The box around the bodies and what of the colliders belongs into a picture of them.
  Eigen::AlignedBox3d box(const sim::State& state) const;

 private:
  Eigen::Vector3d camera_path(const sim::State& state) const;
  Eigen::Vector3d followed_mean(const Eigen::MatrixX3d& of_particles) const;

  const Scene& scene_;
  const Simulation& simulation_;
  std::vector<sim::Skin> skin_;
  std::vector<DrawnCollider> collider_;
  std::optional<Motes> motes_;
  bool wants_strain_;
};

}  // namespace billow::cli
