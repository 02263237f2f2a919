// Lines of `billow check`.
#include "cli/scene/contact_text.h"

#include <fmt/format.h>

namespace billow::cli {

namespace {

std::string millimetres(double metres) { return fmt::format("{:.3g} mm", 1e3 * metres); }

std::string line_of(const std::string& name, const sim::BodyContact& body) {
  if (!body.touches) return fmt::format("contact: body {} passes through everything", name);
  return fmt::format("contact: body {}, {} faces, thickness {}, friction {:.3g}, {}", name, body.face.size(),
                     millimetres(body.thickness), body.friction, body.self ? "also with itself" : "not with itself");
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
  for (const sim::Collider& collider : scene.contact->collider) lines.push_back(line_of(collider));
  return lines;
}

}  // namespace billow::cli
