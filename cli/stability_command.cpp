// billow stability: k0, and every scheme's step limits, with and without the scene's filter.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <nlohmann/json.hpp>

#include "cli/application.h"
#include "cli/commands.h"
#include "cli/simulation.h"
#include "sim/certificate.h"
#include "sim/measured_limit.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

/// One limit [s]: a number, none (unlimited), or not looked for.
struct Limit {
  bool known = false;
  std::optional<double> step;
};

/// One row of the table.
struct Row {
  sim::Method method;
  bool filtered = false;
  Limit paper, certified, any_shape, measured;
};

Limit limit_of(const sim::CertifiedStep& c) { return {true, c.unlimited ? std::nullopt : std::make_optional(c.step)}; }
Limit limit_of(const sim::MeasuredStep& m) { return {true, m.unlimited ? std::nullopt : std::make_optional(m.step)}; }

/// What all rows share.
struct Study {
  const Scene& scene;
  const Simulation& simulation;
  sim::State state;  // that the certificates are about
  sim::Linearisation linearisation, any_shape;
  std::optional<sim::Filter> filter;
  sim::EigenvalueEstimate k0;
  std::optional<sim::EigenvalueEstimate> filtered;
};

// A force filter has no place in an implicit scheme.
bool applies(const sim::Filter& filter, sim::Method method) {
  return sim::is_explicit(method) || filter.options().target == sim::FilterTarget::velocity;
}

std::vector<Row> rows_of(const Study& study) {
  std::vector<Row> rows;
  for (const bool filtered : {false, true})
    for (const sim::Method method : {sim::Method::forward_euler, sim::Method::fb_euler, sim::Method::verlet,
                                     sim::Method::rk4, sim::Method::backward_euler, sim::Method::imex})
      if (!filtered || (study.filter && applies(*study.filter, method)))
        rows.push_back({method, filtered, {}, {}, {}, {}});
  return rows;
}

Limit certified(const Study& study, const Row& row, const sim::Linearisation& linearisation) {
  return limit_of(sim::certified_step(study.simulation.structure(), linearisation, study.state.position, row.method,
                                      study.scene.solver.integrator, row.filtered ? &*study.filter : nullptr));
}

Limit measured(const Study& study, const Row& row, double duration) {
  sim::SolverOptions options;
  options.method = row.method;
  options.integrator = study.scene.solver.integrator;
  if (row.filtered) options.filter = study.simulation.filter();
  const Simulation& simulation = study.simulation;
  const double scale =
      sim::energy_scale(simulation.structure(), simulation.forces(), study.scene.gravity, simulation.initial_state());
  const double unit = 2.0 / std::sqrt(study.k0.value);
  // A scheme without a certified limit is tried at the paper's implicit step and somewhat beyond.
  const double guess = row.certified.step && *row.certified.step > 0.0 ? *row.certified.step : unit;
  const double first = sim::is_explicit(row.method) ? guess : 5.0 * unit;
  return limit_of(sim::measured_step(simulation.structure(), simulation.forces(), options, simulation.initial_state(),
                                     scale, first, 10.0 * unit, {.duration = duration}));
}

// Two certificates a row, each a task of its own, so that the dear ones of RK4 spread over the cores.
void certify(const Study& study, std::vector<Row>& rows) {
  for (Row& row : rows)
    row.paper = {true, sim::paper_step(row.method, row.filtered ? study.filtered->value : study.k0.value)};
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, 2 * rows.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          Row& row = rows[k / 2];
          const bool at_state = k % 2 == 0;
          (at_state ? row.certified : row.any_shape) =
              certified(study, row, at_state ? study.linearisation : study.any_shape);
        }
      },
      tbb::simple_partitioner());
}

sim::State state_at(const Simulation& simulation, double time) {
  if (time == 0.0) return simulation.initial_state();
  return simulation.make_solver(simulation.choose_step())->sample(time);
}

Study make_study(const Scene& scene, const Simulation& simulation, double time) {
  const sim::Structure& structure = simulation.structure();
  const sim::State state = state_at(simulation, time);
  const auto about = [&](double position, double velocity) {
    return simulation.forces().linearise(state, position, velocity, sim::JacobianForm::definite);
  };
  Study study{scene,
              simulation,
              state,
              time == 0.0 ? sim::linearise_at_rest(structure) : sim::Linearisation{about(1.0, 0.0), about(0.0, 1.0)},
              sim::linearise_any_shape(structure),
              {},
              {},
              {}};
  study.k0 = sim::max_eigenvalue(structure, study.linearisation.stiffness);
  if (!simulation.filter()) return study;
  study.filter.emplace(structure, *simulation.filter());
  study.filtered = sim::filtered_eigenvalue(structure, study.linearisation.stiffness, *study.filter);
  return study;
}

Json as_json(const Limit& limit) { return limit.step ? Json(*limit.step) : Json(); }

Json as_json(const Study& study, const std::vector<Row>& rows) {
  Json json = {{"k0", study.k0.value}, {"k0_converged", study.k0.converged}};
  json["filtered_eigenvalue"] = study.filtered ? Json(study.filtered->value) : Json();
  if (study.filtered) json["filtered_eigenvalue_converged"] = study.filtered->converged;
  json["time"] = study.state.time;
  json["limits"] = Json::array();
  for (const Row& row : rows) {
    Json entry = {{"method", sim::name(row.method)}, {"filtered", row.filtered}};
    entry["target"] = row.filtered ? Json(sim::name(study.filter->options().target)) : Json();
    entry["paper"] = as_json(row.paper);
    entry["certified"] = as_json(row.certified);
    entry["any_shape"] = as_json(row.any_shape);
    if (row.measured.known) entry["measured"] = as_json(row.measured);
    json["limits"].push_back(entry);
  }
  return json;
}

std::string shown(const Limit& limit) {
  if (!limit.known) return "";
  if (!limit.step) return "none";
  return *limit.step == 0.0 ? "0 (grows)" : fmt::format("{:.4f}", 1e3 * *limit.step);
}

void print_table(const Study& study, const std::vector<Row>& rows) {
  const bool has_measured = rows.front().measured.known;
  fmt::print("k0 = {:.6g} /s² by the power method ({} iterations{})\n", study.k0.value, study.k0.iterations,
             study.k0.converged ? "" : ", NOT converged");
  if (study.filtered)
    fmt::print("Algorithm 1: {:.6g} /s² with the scene's {} filter ({} iterations{})\n", study.filtered->value,
               sim::name(study.filter->options().target), study.filtered->iterations,
               study.filtered->converged ? "" : ", NOT converged");
  fmt::print("\nlargest stable step [ms] at t = {:g} s\n{:<16}{:<10}{:>12}{:>12}{:>12}{:>12}\n", study.state.time,
             "method", "filter", "paper", "certified", "any shape", has_measured ? "measured" : "");
  for (const Row& row : rows)
    fmt::print("{:<16}{:<10}{:>12}{:>12}{:>12}{:>12}\n", sim::name(row.method),
               row.filtered ? sim::name(study.filter->options().target) : "-", shown(row.paper), shown(row.certified),
               shown(row.any_shape), shown(row.measured));
  fmt::print(
      "\npaper: equation 11 and Algorithm 1. certified: no growth of the linearised step at this state. any shape: "
      "the\n"
      "same for the stiffest that any fold can be. none: no limit found.\n");
}

}  // namespace

int stability_command(const StabilityOptions& options) {
  const Scene scene = read_scene(options.scene.scene, options.scene.overrides);
  const Simulation simulation(scene);
  const Study study = make_study(scene, simulation, options.time);
  std::vector<Row> rows = rows_of(study);
  certify(study, rows);
  if (options.measured)
    tbb::parallel_for(
        std::size_t{0}, rows.size(),
        [&](std::size_t r) { rows[r].measured = measured(study, rows[r], scene.duration); }, tbb::simple_partitioner());
  if (options.scene.json)
    fmt::print("{}\n", as_json(study, rows).dump(2));
  else
    print_table(study, rows);
  return exit_done;
}

}  // namespace billow::cli
