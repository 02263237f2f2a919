// solver: in a scene: scheme, step and filter.
#include <fmt/format.h>

#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_parts.h"
#include "cli/text/number_text.h"

namespace billow::cli {
namespace {

void check_keys_ascend(const Node& node, const std::vector<std::pair<double, double>>& keys) {
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i].first <= keys[i - 1].first)
      fail_at(node.items[i]->where, fmt::format("lambda_keys[{}] is no later than the one before it", i));
}

std::pair<double, double> read_lambda_key(const Node& node, std::size_t index, const Range& times) {
  const std::string name = fmt::format("lambda_keys[{}]", index);
  if (node.kind != Node::Kind::list || node.items.size() != 2)
    fail_at(node.where, name + " must be a pair [time, factor]");
  const double time = read_number(*node.items[0], name + "[0]", times);
  return {time, read_number(*node.items[1], name + "[1]", {0.0, 1e3, true})};
}

std::vector<std::pair<double, double>> read_lambda_keys(MapReader& filter) {
  std::vector<std::pair<double, double>> keys;
  std::vector<NodePtr> record;
  if (const Node* node = filter.find("lambda_keys")) {
    for (const NodePtr& item : read_list(*node, "lambda_keys")) {
      keys.push_back(read_lambda_key(*item, keys.size(), filter.key("lambda_keys").range));
      record.push_back(make_list({record_of(keys.back().first), record_of(keys.back().second)}));
    }
    check_keys_ascend(*node, keys);
  }
  filter.record("lambda_keys", make_list(std::move(record)));
  return keys;
}

// A number, or a formula over the particles in quotes.
void read_lambda(MapReader& map, SolverSpec& solver) {
  const Node* node = map.find("lambda");
  if (!node || node->kind != Node::Kind::scalar || !node->quoted) {
    solver.filter->lambda = map.number("lambda", solver.filter->lambda);
    return;
  }
  solver.lambda_expression = read_text(*node, "lambda");
  map.record("lambda", make_scalar(node->text, true));
}

void refuse_keys(const MapReader& filter, std::initializer_list<std::string_view> keys, std::string_view advice) {
  for (const std::string_view key : keys)
    if (filter.find(key)) fail_at(filter.where(key), fmt::format("'{}' means nothing here: {}", key, advice));
}

void read_levels(MapReader& map, SolverSpec& solver) {
  refuse_keys(map, {"lambda", "lambda_keys", "form", "neighbours", "radius", "distances", "passes"},
              "levels are set by their 'ratio' alone");
  sim::FilterOptions& filter = *solver.filter;
  filter.target = map.choice("target", sim::FilterTarget::force);
  if (filter.target != sim::FilterTarget::force)
    fail_at(map.where("target"), "levels filter forces: of velocities they would damp every fold; use 'target: force'");
  const std::optional<double> ratio = map.number_or_word("ratio");
  solver.levels_choose = !ratio;
  if (ratio) filter.ratio = *ratio;
  solver.filter_where = map.where("ratio");
}

void read_filter(MapReader& parent, SolverSpec& solver) {
  if (parent.is_none("filter")) return;
  MapReader map = parent.map("filter", keys::section("solver.filter"));
  sim::FilterOptions& filter = solver.filter.emplace();
  filter.kernel = map.choice("kernel", filter.kernel);
  if (filter.kernel == sim::FilterKernel::levels) return read_levels(map, solver);
  refuse_keys(map, {"ratio"}, "it belongs to 'kernel: levels'");
  solver.filter_where = map.where("lambda");
  read_lambda(map, solver);
  filter.lambda_keys = read_lambda_keys(map);
  filter.form = map.choice("form", filter.form);
  filter.target = map.choice("target", filter.target);
  filter.neighbours = map.choice("neighbours", filter.neighbours);
  filter.radius = map.number("radius", filter.radius);
  filter.distances = map.choice("distances", filter.distances);
  filter.passes = map.integer("passes", filter.passes);
}

// auto, paper, or seconds.
void read_step(MapReader& map, double duration, SolverSpec& solver) {
  const Node* node = map.find("step");
  if (!node || is_word(*node, "auto") || is_word(*node, "paper")) {
    solver.step_rule = node && node->text == "paper" ? StepRule::paper : StepRule::automatic;
    map.record("step", make_scalar(node ? node->text : "auto"));
    return;
  }
  solver.step_rule = StepRule::fixed;
  solver.step = map.number("step");
  if (solver.step > duration)
    fail_at(node->where, fmt::format("step is {} s, longer than the whole scene of {} s", shortest(solver.step),
                                     shortest(duration)));
}

}  // namespace

SolverSpec read_solver(MapReader& scene, double duration) {
  MapReader map = scene.map("solver", keys::section("solver"));
  SolverSpec solver;
  solver.method = map.choice("method", solver.method);
  read_step(map, duration, solver);
  solver.safety = map.number("safety", solver.safety);
  solver.watch = map.boolean("watch", solver.step_rule == StepRule::automatic);
  solver.integrator.linear_solver = map.choice("linear_solver", solver.integrator.linear_solver);
  solver.integrator.tolerance = map.number("tolerance", solver.integrator.tolerance);
  solver.integrator.max_iterations = map.integer("max_iterations", solver.integrator.max_iterations);
  read_filter(map, solver);
  // The implicit schemes solve for velocities: there is no single force that a filter could take.
  if (solver.filter && solver.filter->target == sim::FilterTarget::force && !sim::is_explicit(solver.method)) {
    const bool levels = solver.filter->kernel == sim::FilterKernel::levels;
    fail_at(map.where("filter"),
            fmt::format("{} an explicit method, and {} is implicit; {}",
                        levels ? "levels need" : "a force filter needs", sim::name(solver.method),
                        levels ? "use fb_euler, or filter nothing" : "filter the velocity, or nothing"));
  }
  return solver;
}

}  // namespace billow::cli
