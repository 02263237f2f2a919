// Where a run's bodies and colliders are, in the vertices of their files: what other programs get.
#pragma once

#include <vector>

#include "cli/cache/cache_writer.h"
#include "cli/run/run.h"

namespace billow::cli {

/// The bodies, then the colliders, a plane as the square that is drawn of it. Of a fish it is its skin, without a mesh
/// the faces between its particles.
class CacheGeometry {
 public:
  /// What `run` refers to must outlive this.
  explicit CacheGeometry(const Run& run);

  const std::vector<CacheMesh>& meshes() const { return mesh_; }
  /// All of them at `state`, in the world, whatever the camera follows. Colliders have neither strain nor contact.
  std::vector<CacheFrame> at(long number, double time, const sim::State& state) const;

 private:
  void add_body_frames(const sim::State& state, std::vector<CacheFrame>& frames) const;
  void add_collider_frames(const sim::State& state, std::vector<CacheFrame>& frames) const;

  const Simulation& simulation_;
  const DrawnScene& drawn_;
  std::vector<CacheMesh> mesh_;
};

}  // namespace billow::cli
