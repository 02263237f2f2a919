// billow structure: particles and springs as built, for other tools.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/text/json_text.h"
#include "cli/text/terminal.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

Json as_json(const sim::Structure& s) {
  Json json = {{"particles", Json::array()}, {"springs", Json::array()}};
  for (int i = 0; i < s.particles(); ++i)
    json["particles"].push_back({{"position", {s.rest_position(i, 0), s.rest_position(i, 1), s.rest_position(i, 2)}},
                                 {"mass", s.mass(i)},
                                 {"pinned", s.pinned(i)}});
  for (int k = 0; k < s.springs(); ++k)
    json["springs"].push_back({{"i", s.spring(k, 0)},
                               {"j", s.spring(k, 1)},
                               {"rest_length", s.rest_length(k)},
                               {"stiffness", s.stiffness(k)},
                               {"damping", s.damping(k)},
                               {"kind", sim::name(s.kind[k])}});
  return json;
}

// One value, or the smallest and the largest.
std::string extent(const Eigen::VectorXd& values, std::string_view unit) {
  const std::string low = fmt::format("{:.4g}", values.minCoeff()), high = fmt::format("{:.4g}", values.maxCoeff());
  return low == high ? fmt::format("{} {}", low, unit) : fmt::format("{} to {} {}", low, high, unit);
}

void print_summary(const sim::Structure& s) {
  for (const sim::Body& body : s.body) {
    const auto mass = s.mass.segment(body.first_particle, body.particles);
    print_line("{}: {} particles of {:.4g} to {:.4g} kg, {:.4g} kg in all, {} pinned", body.name, body.particles,
               mass.minCoeff(), mass.maxCoeff(), mass.sum(),
               (s.inverse_mass.segment(body.first_particle, body.particles).array() == 0.0).count());
    std::map<sim::SpringKind, std::vector<int>> kinds;
    for (int k = body.first_spring; k < body.first_spring + body.springs; ++k) kinds[s.kind[k]].push_back(k);
    for (const auto& [kind, springs] : kinds)
      print_line("  {:<10} {:>7} springs of {}, {}", name(kind), springs.size(), extent(s.stiffness(springs), "N/m"),
                 extent(s.rest_length(springs), "m"));
  }
}

}  // namespace

int structure_command(const SceneOptions& options) {
  const sim::Structure structure = build_structure(read_scene(options.scene, options.overrides));
  if (options.json)
    print_json(json_text(as_json(structure)));
  else
    print_summary(structure);
  return exit_done;
}

}  // namespace billow::cli
