// Walking along edges that only one face has.
#include "sim/mesh/boundary.h"

#include <algorithm>
#include <map>

#include "sim/mesh/mesh_edges.h"
#include "sim/mesh/polygon.h"

namespace billow::sim {
namespace {

struct BorderEdge {
  int from, to, face;
  bool walked = false;
};

// Along the direction in which their face runs, ascending.
std::vector<BorderEdge> border_edges(const Mesh& mesh) {
  std::vector<BorderEdge> border;
  for (const Edge& edge : distinct_edges(mesh)) {
    if (edge.face.size() != 1) continue;
    const bool forward = use_of(mesh.face[static_cast<std::size_t>(edge.face[0])], edge).direction > 0;
    border.push_back({forward ? edge.first : edge.second, forward ? edge.second : edge.first, edge.face[0]});
  }
  std::stable_sort(border.begin(), border.end(),
                   [](const BorderEdge& a, const BorderEdge& b) { return a.from < b.from; });
  return border;
}

struct Loop {
  std::vector<int> vertex;
  int face;  // one that it runs along
  bool closed;
};

std::vector<Loop> walk(std::vector<BorderEdge> border) {
  const auto leaving = [&](int vertex) {
    auto edge = std::lower_bound(border.begin(), border.end(), vertex,
                                 [](const BorderEdge& e, int from) { return e.from < from; });
    while (edge != border.end() && edge->from == vertex && edge->walked) ++edge;
    return edge != border.end() && edge->from == vertex ? &*edge : nullptr;
  };
  std::vector<Loop> loops;
  for (BorderEdge& start : border) {
    if (start.walked) continue;
    Loop loop{{}, start.face, false};
    for (BorderEdge* edge = &start; edge; edge = leaving(edge->to)) {
      edge->walked = true;
      loop.vertex.push_back(edge->from);
      loop.closed = edge->to == start.from;
      if (loop.closed) break;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

// Texture coordinates of a vertex at one of its faces.
std::map<int, Eigen::Vector2f> uv_of_vertices(const Mesh& mesh) {
  std::map<int, Eigen::Vector2f> uv;
  for (std::size_t f = 0; f < mesh.uv.size(); ++f)
    for (int c = 0; c < corner_count(mesh.face[f]); ++c) uv.try_emplace(mesh.face[f][c], mesh.uv[f][c]);
  return uv;
}

}  // namespace

std::vector<std::vector<int>> border_loops(const Mesh& mesh) {
  std::vector<std::vector<int>> loops;
  for (Loop& loop : walk(border_edges(mesh))) loops.push_back(std::move(loop.vertex));
  return loops;
}

Mesh with_holes_closed(const Mesh& mesh, int most_edges) {
  Mesh closed = mesh;
  const std::map<int, Eigen::Vector2f> uv = uv_of_vertices(mesh);
  for (Loop& loop : walk(border_edges(mesh))) {
    if (!loop.closed || loop.vertex.size() > static_cast<std::size_t>(most_edges) || loop.vertex.size() < 3) continue;
    std::reverse(loop.vertex.begin(), loop.vertex.end());  // the new face runs along the border the other way
    for (const Face& cut : polygon_faces(mesh.position(loop.vertex, Eigen::all))) {
      Face face = cut;
      std::array<Eigen::Vector2f, 4> corner_uv;
      corner_uv.fill(Eigen::Vector2f::Zero());
      for (int c = 0; c < corner_count(cut); ++c) {
        face[c] = loop.vertex[static_cast<std::size_t>(cut[c])];
        if (!uv.empty()) corner_uv[c] = uv.at(face[c]);
      }
      closed.face.push_back(face);
      if (!mesh.uv.empty()) closed.uv.push_back(corner_uv);
      if (!mesh.face_material.empty())
        closed.face_material.push_back(mesh.face_material[static_cast<std::size_t>(loop.face)]);
    }
  }
  return closed;
}

}  // namespace billow::sim
