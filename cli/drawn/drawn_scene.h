// What is drawn of a simulation: its bodies' skins, what they collide with, and the specks in the water around them.
#pragma once

#include <optional>
#include <vector>

#include "cli/drawn/drawn_collider.h"
#include "cli/drawn/motes.h"
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
  /// Where all of those are at `state`, as the camera sees it: moved along with the body that it follows, and seen from
  /// the origin.
  std::vector<sim::SurfaceState> surfaces(const sim::State& state) const;
  /// The drawn bodies, then the colliders: what takes up room in the scene.
  std::vector<render::DrawnBody> solids() const;
  /// The place in the world [m] that pictures are drawn around: single precision, which GL and many files have, is
  /// finest near it. Zero unless the scene lies far from there.
  const Eigen::Vector3d& origin() const { return origin_; }
  /// The scene's settings, camera and ground as seen from the origin.
  render::Settings settings() const;
  /// Where those are at `state` [m], seen from the origin.
  std::vector<sim::SurfaceState> solid_surfaces(const sim::State& state) const;
  /// What is drawn of each body, and where all of that is at `state` in the world.
  const std::vector<sim::Skin>& skins() const { return skin_; }
  std::vector<sim::SurfaceState> skins_at(const sim::State& state,
                                          const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) const;
  const std::vector<DrawnCollider>& colliders() const { return collider_; }
  /// Of that camera [m/s].
  Eigen::Vector3d camera_velocity(const sim::State& state) const;
  /// The box in the world [m] around the bodies and what of the colliders belongs into a picture of them.
  Eigen::AlignedBox3d box(const sim::State& state) const;

 private:
  Eigen::Vector3d camera_path(const sim::State& state) const;
  void add_strain(const sim::State& state, std::vector<sim::SurfaceState>& surfaces) const;
  std::vector<sim::SurfaceState> solids_from(const Eigen::Vector3d& origin, const sim::State& state) const;
  Eigen::Vector3d followed_mean(const Eigen::MatrixX3d& of_particles) const;

  const Scene& scene_;
  const Simulation& simulation_;
  Eigen::Vector3d origin_;
  std::vector<sim::Skin> skin_;
  std::vector<DrawnCollider> collider_;
  std::optional<Motes> motes_;
  bool wants_strain_;
};

}  // namespace billow::cli
