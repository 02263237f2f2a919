// Words for filters and their levels.
#include "cli/scene/filter_text.h"

#include <fmt/format.h>

namespace billow::cli {

std::string filter_text(const Scene& scene, const Simulation& simulation) {
  if (!scene.solver.filter) return "none";
  if (!simulation.filter()) return "none, as no levels are needed for this step";
  const sim::FilterOptions& filter = *simulation.filter();
  if (filter.kernel == sim::FilterKernel::levels)
    return fmt::format("levels ×{:.3g}, of {}", filter.ratio, sim::name(filter.target));
  const std::string lambda =
      scene.solver.lambda_expression.empty() ? fmt::format("{:.4g}", filter.lambda) : scene.solver.lambda_expression;
  return fmt::format("{}, λ = {}{}, {}, of {}{}", word_of(filter.kernel), lambda,
                     filter.lambda_keys.empty() ? "" : " (changing over time)", word_of(filter.form),
                     sim::name(filter.target), filter.passes > 1 ? fmt::format(", {} passes", filter.passes) : "");
}

std::vector<std::string> level_lines(const Simulation& simulation) {
  std::vector<std::string> lines;
  if (!simulation.filter_operator()) return lines;
  const std::vector<sim::LevelTable> bodies = simulation.filter_operator()->levels();
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t l = 0; l < bodies[b].nodes.size(); ++l) {
      const bool last = l > 0 && l + 1 == bodies[b].nodes.size();
      lines.push_back(fmt::format("{}, level {}: {} {}, γ = {:.4f}{}", simulation.structure().body[b].name, l,
                                  bodies[b].nodes[l], l == 0 ? "particles" : "nodes", bodies[b].shares.gamma[l],
                                  last ? fmt::format(", correction {:.2f}", bodies[b].shares.correction) : ""));
    }
  return lines;
}

}  // namespace billow::cli
