// Looking for vertices.
#include "sim/mesh/selection.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/suggest.h"
#include "sim/mesh/planar_uv.h"

namespace billow::sim {
namespace {

// A vertex together with one of its places on the texture: a vertex on a seam has several.
struct Placed {
  int vertex;
  Eigen::Vector2d uv;
};

std::vector<Placed> placed_vertices(const Mesh& mesh) {
  std::vector<Placed> placed;
  if (mesh.uv.empty()) {
    const Eigen::MatrixX2d uv = planar_uv(mesh);
    for (int v = 0; v < mesh.vertices(); ++v) placed.push_back({v, uv.row(v)});
  }
  for (std::size_t f = 0; f < mesh.uv.size(); ++f)
    for (int c = 0; c < corner_count(mesh.face[f]); ++c)
      placed.push_back({mesh.face[f][c], mesh.uv[f][c].cast<double>()});
  return placed;
}

Eigen::Vector2d target_of(Corner corner, const Eigen::AlignedBox2d& rectangle) {
  const bool left = corner == Corner::top_left || corner == Corner::bottom_left;
  const bool top = corner == Corner::top_left || corner == Corner::top_right;
  return {left ? rectangle.min().x() : rectangle.max().x(), top ? rectangle.max().y() : rectangle.min().y()};
}

std::vector<int> select(const Mesh& mesh, Corner corner) {
  const std::vector<Placed> placed = placed_vertices(mesh);
  Eigen::AlignedBox2d rectangle;
  for (const Placed& p : placed) rectangle.extend(p.uv);
  const Eigen::Vector2d target = target_of(corner, rectangle);
  int best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const auto& [vertex, uv] : placed) {
    const double distance = (uv - target).squaredNorm();
    if (distance < best_distance || (distance == best_distance && vertex < best)) {
      best_distance = distance;
      best = vertex;
    }
  }
  return {best};
}

std::vector<int> select(const Mesh& mesh, const VertexList& list) {
  if (list.vertices.empty()) throw InputError("the list of vertices is empty; name at least one");
  for (const int v : list.vertices)
    if (v < 0 || v >= mesh.vertices())
      throw InputError(fmt::format("there is no vertex {}: the mesh has {}, numbered 0 to {}", v, mesh.vertices(),
                                   mesh.vertices() - 1));
  std::vector<int> vertices = list.vertices;
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::string text(const Eigen::Vector3d& v) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x(), v.y(), v.z()); }

std::vector<int> select(const Mesh& mesh, const Eigen::AlignedBox3d& box) {
  std::vector<int> inside;
  for (int v = 0; v < mesh.vertices(); ++v)
    if (box.contains(mesh.position.row(v).transpose())) inside.push_back(v);
  if (inside.empty())
    throw InputError(fmt::format("the box {} to {} holds no vertex: the mesh lies in {} to {}", text(box.min()),
                                 text(box.max()), text(mesh.position.colwise().minCoeff()),
                                 text(mesh.position.colwise().maxCoeff())));
  return inside;
}

std::vector<int> select(const Mesh& mesh, const GroupName& wanted) {
  if (const auto found = mesh.group.find(wanted.name); found != mesh.group.end()) return found->second;
  if (mesh.group.empty())
    throw InputError(fmt::format("there is no group '{}': the mesh has no named groups", wanted.name));
  std::vector<std::string_view> names;
  for (const auto& [name, vertices] : mesh.group) names.push_back(name);
  const std::string_view close = closest_name(wanted.name, names);
  throw InputError(fmt::format("there is no group '{}' in the mesh; {}it has '{}'", wanted.name,
                               close.empty() ? "" : fmt::format("did you mean '{}'? ", close),
                               fmt::join(names, "', '")));
}

// The weights of that name (v); none where the mesh has none.
std::optional<Eigen::VectorXf> weights_of(const Mesh& mesh, const std::string& name) {
  if (const auto found = mesh.weight.find(name); found != mesh.weight.end()) return found->second;
  constexpr std::string_view channels[] = {"red", "green", "blue"};
  const auto channel = std::find(std::begin(channels), std::end(channels), name);
  if (channel != std::end(channels) && mesh.colour.rows() > 0)
    return mesh.colour.col(static_cast<Eigen::Index>(channel - std::begin(channels)));
  const auto group = mesh.group.find(name);
  if (group == mesh.group.end()) return std::nullopt;
  Eigen::VectorXf weight = Eigen::VectorXf::Zero(mesh.vertices());
  for (const int v : group->second) weight(v) = 1.0f;
  return weight;
}

std::string weight_names(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const auto& [name, weight] : mesh.weight) names.push_back(name);
  if (mesh.colour.rows() > 0) names.insert(names.end(), {"red", "green", "blue"});
  for (const auto& [name, vertices] : mesh.group) names.push_back(name);
  if (names.empty()) return "the mesh has neither weights nor colours nor groups";
  return fmt::format("the mesh has '{}'", fmt::join(names, "', '"));
}

std::vector<int> select(const Mesh& mesh, const WeightAbove& wanted) {
  const std::optional<Eigen::VectorXf> weight = weights_of(mesh, wanted.name);
  if (!weight) throw InputError(fmt::format("there are no weights '{}'; {}", wanted.name, weight_names(mesh)));
  std::vector<int> above;
  for (int v = 0; v < mesh.vertices(); ++v)
    if ((*weight)(v) > wanted.bound) above.push_back(v);
  if (above.empty())
    throw InputError(fmt::format("no vertex has a weight '{}' over {:.6g}: they go from {:.6g} to {:.6g}", wanted.name,
                                 wanted.bound, weight->minCoeff(), weight->maxCoeff()));
  return above;
}

}  // namespace

Words<Corner> words(Corner) {
  static constexpr Word<Corner> list[] = {{"top_left", Corner::top_left},
                                          {"top_right", Corner::top_right},
                                          {"bottom_left", Corner::bottom_left},
                                          {"bottom_right", Corner::bottom_right}};
  return list;
}

std::vector<int> select_vertices(const Mesh& mesh, const Selector& selector) {
  return std::visit([&mesh](const auto& wanted) { return select(mesh, wanted); }, selector);
}

}  // namespace billow::sim
