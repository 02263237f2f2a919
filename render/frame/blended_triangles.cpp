// Sorting triangles by depth.
#include "render/frame/blended_triangles.h"

#include <algorithm>

#include "render/frame/camera.h"

namespace billow::render {
namespace {

struct Seen {
  float depth;  // [m] along the camera's axis, of the middle, times three
  int albedo, triangle;
};

std::vector<Seen> sorted_triangles(const FrameParts& frame) {
  const Eigen::RowVector3f back = view_matrix(frame.stage.camera).row(2).head<3>().cast<float>();
  std::vector<Seen> seen;
  for (std::size_t a = 0; a < frame.albedos.size(); ++a) {
    const Albedo& albedo = frame.albedos[a];
    if (albedo.alpha != AlphaMode::blend) continue;
    const BodyMesh& mesh = frame.meshes[albedo.body];
    for (int t = albedo.triangles.first; t < albedo.triangles.first + albedo.triangles.count; ++t) {
      float depth = 0.0f;
      for (int c = 0; c < 3; ++c)
        depth -=
            back * Eigen::Vector3f(mesh.corners()[static_cast<std::size_t>(mesh.surface().triangle(t, c))].position);
      seen.push_back({depth, static_cast<int>(a), t});
    }
  }
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& x, const Seen& y) { return x.depth > y.depth; });
  return seen;
}

}  // namespace

void BlendedTriangles::draw(const FrameParts& frame, const std::function<void(const Albedo&)>& set_finish) const {
  const std::vector<Seen> seen = sorted_triangles(frame);
  std::vector<GLuint> corner;
  for (const Seen& triangle : seen) {
    const BodyMesh& mesh = frame.meshes[frame.albedos[static_cast<std::size_t>(triangle.albedo)].body];
    for (int c = 0; c < 3; ++c) corner.push_back(static_cast<GLuint>(mesh.surface().triangle(triangle.triangle, c)));
  }
  for (std::size_t begin = 0, end = 0; begin < seen.size(); begin = end) {
    while (end < seen.size() && seen[end].albedo == seen[begin].albedo) ++end;
    const Albedo& albedo = frame.albedos[static_cast<std::size_t>(seen[begin].albedo)];
    set_finish(albedo);
    frame.meshes[albedo.body].draw_corners(index_, corner.data() + 3 * begin, 3 * (end - begin));
  }
}

}  // namespace billow::render
