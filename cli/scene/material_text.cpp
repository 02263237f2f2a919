// Lines of `billow check`.
#include "cli/scene/material_text.h"

#include <fmt/format.h>

namespace billow::cli {

namespace {

bool has_material(const FishSpec&) { return false; }
bool has_material(const ClothSpec& cloth) { return cloth.density || cloth.options.material; }
bool has_material(const SoftSpec& soft) { return soft.density || soft.options.young; }

}  // namespace

std::vector<std::string> material_lines(const Scene& scene, const sim::Structure& structure) {
  std::vector<std::string> lines;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (!std::visit([](const auto& kind) { return has_material(kind); }, scene.bodies[b].kind)) continue;
    const sim::Body& body = structure.body[b];
    const auto stiffness = structure.stiffness.segment(body.first_spring, body.springs);
    lines.push_back(fmt::format("material: body {} weighs {:.4g} kg and has {} springs of {:.4g} to {:.4g} N/m",
                                body.name, structure.mass.segment(body.first_particle, body.particles).sum(),
                                body.springs, stiffness.minCoeff(), stiffness.maxCoeff()));
  }
  return lines;
}

}  // namespace billow::cli
