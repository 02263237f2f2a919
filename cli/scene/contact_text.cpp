// Lines of `billow check`.
#include "cli/scene/contact_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/mesh/mesh_edges.h"

namespace billow::cli {

namespace {

std::string millimetres(double metres) { return fmt::format("{:.3g} mm", 1e3 * metres); }

std::string line_of(const std::string& name, const sim::BodyContact& body) {
  if (!body.touches) return fmt::format("contact: body {} passes through everything", name);
  return fmt::format("contact: body {}, {} faces, thickness {}, friction {:.3g}, {}", name, body.face.size(),
                     millimetres(body.thickness), body.friction, body.self ? "also with itself" : "not with itself");
}

// Where a body touches itself, its own neighbours are nearer than a thickness that is wider than its edges.
std::string finer_text(const BodySpec& spec, const sim::BodyContact& body) {
  if (!body.touches || !body.self) return "";
  const sim::Mesh mesh = touching_mesh(spec);
  int shorter = 0, edges = 0;
  double shortest = INFINITY;
  for (const sim::Edge& edge : sim::distinct_edges(mesh)) {
    const double length = (mesh.position.row(edge.second) - mesh.position.row(edge.first)).norm();
    shorter += length < body.thickness, ++edges;
    shortest = std::min(shortest, length);
  }
  if (shorter == 0) return "";
  return fmt::format(
      "warning: {} of the {} edges of '{}' are shorter than the thickness of its contact, the shortest {}: parts of it "
      "that rest nearer than the thickness keep nine tenths of how far they rest; give it less thickness or a coarser "
      "mesh",
      shorter, edges, spec.name, millimetres(shortest));
}

std::string line_of(const sim::Collider& collider) {
  const std::string what = collider.half_space ? "a half-space" : fmt::format("{} faces", collider.mesh.face.size());
  return fmt::format("contact: collider {}, {}, thickness {}, friction {:.3g}, {}", collider.name, what,
                     millimetres(collider.thickness), collider.friction, collider.motion.moves() ? "moves" : "still");
}

}  // namespace

std::vector<std::string> contact_lines(const Scene& scene) {
  std::vector<std::string> lines;
  if (!scene.contact) return lines;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    lines.push_back(line_of(scene.bodies[b].name, scene.contact->body[b]));
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (std::string text = finer_text(scene.bodies[b], scene.contact->body[b]); !text.empty())
      lines.push_back(std::move(text));
  for (const sim::Collider& collider : scene.contact->collider) lines.push_back(line_of(collider));
  return lines;
}

}  // namespace billow::cli
