// What is drawn of a simulation: its bodies' skins, and the specks in the water around them.
#pragma once

#include <optional>
#include <vector>

#include "cli/run/motes.h"
#include "cli/scene/simulation.h"
#include "render/frame/mesh_renderer.h"
#include "sim/drawn/skin.h"

namespace billow::cli {

class DrawnScene {
 public:
  /// Both must outlive this.
  DrawnScene(const Scene& scene, const Simulation& simulation);

  /// The drawn bodies, textures included; motes, where the water has any, come last.
  std::vector<render::DrawnBody> bodies() const;
  /// Where the drawn bodies are at `state`, as the camera sees it: moved along with the body that it follows.
  std::vector<sim::SurfaceState> surfaces(const sim::State& state) const;
  /// The box around them, what drifts in the water left out.
  Eigen::AlignedBox3d box(const sim::State& state) const;

 private:
  Eigen::Vector3d camera_path(const sim::State& state) const;

  const Scene& scene_;
  const Simulation& simulation_;
  std::vector<sim::Skin> skin_;
  std::optional<Motes> motes_;
};

}  // namespace billow::cli
