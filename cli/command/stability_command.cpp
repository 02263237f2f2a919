// billow stability: k0, and every scheme's step limits, with and without the scene's filter.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <nlohmann/json.hpp>

#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/run/measured_run.h"
#include "cli/run/watched_scene.h"
#include "cli/scene/simulation.h"
#include "cli/text/json_text.h"
#include "cli/text/terminal.h"
#include "sim/limit/certificate.h"
#include "sim/limit/filtered_eigenvalue.h"
#include "sim/limit/paper_step.h"

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
struct Subject {
  const Scene& scene;
  const Simulation& simulation;
  const Simulation::Phase& phase;
  sim::State state;  // that the certificates are about
  sim::Linearisation linearisation, any_shape;
  sim::StiffnessMatrix least_damping;   // at any shape
  std::vector<std::string> unbounded;   // laws that no limit counts
  const sim::Filter* filter = nullptr;  // the scene's, or null
  sim::EigenvalueEstimate k0;
  std::optional<sim::EigenvalueEstimate> filtered;
  std::optional<sim::StepSetter> setter;
};

// A force filter has no place in an implicit scheme.
bool applies(const sim::Filter& filter, sim::Method method) {
  return sim::is_explicit(method) || filter.options().target == sim::FilterTarget::velocity;
}

std::vector<Row> rows_of(const Subject& subject) {
  std::vector<Row> rows;
  for (const bool filtered : {false, true})
    for (const sim::Scheme& scheme : sim::schemes())
      if (!filtered || (subject.filter && applies(*subject.filter, scheme.method)))
        rows.push_back({scheme.method, filtered, {}, {}, {}, {}});
  return rows;
}

Limit certified(const Subject& subject, const Row& row, const sim::Linearisation& linearisation,
                const sim::StiffnessMatrix* least_damping) {
  return limit_of(sim::certified_step({.structure = subject.phase.structure,
                                       .linearisation = linearisation,
                                       .position = subject.state.position,
                                       .method = row.method,
                                       .options = subject.scene.solver.integrator,
                                       .filter = row.filtered ? subject.filter : nullptr,
                                       .duration = subject.scene.duration,
                                       .least_damping = least_damping}));
}

Limit measured(const Subject& subject, const Row& row) {
  return limit_of(measure_step(subject.scene, subject.phase, subject.simulation.initial_state(), row.method,
                               row.filtered ? subject.phase.filter : std::nullopt, row.certified.step,
                               subject.k0.value));
}

// Two certificates a row, each a task of its own, so that the dear ones of RK4 spread over the cores.
void certify(const Subject& subject, std::vector<Row>& rows) {
  for (Row& row : rows)
    row.paper = {true, sim::paper_step(row.method, row.filtered ? subject.filtered->value : subject.k0.value)};
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, 2 * rows.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          Row& row = rows[k / 2];
          const bool at_state = k % 2 == 0;
          (at_state ? row.certified : row.any_shape) =
              at_state ? certified(subject, row, subject.linearisation, nullptr)
                       : certified(subject, row, subject.any_shape, &subject.least_damping);
        }
      },
      tbb::simple_partitioner());
}

sim::State state_at(const Simulation& simulation, double time) {
  if (time == 0.0) return simulation.initial_state();
  return simulation.make_solver(simulation.choose_step())->sample(time);
}

// Of a state at rest the phase that leaves the least room: the run has one step for all.
const Simulation::Phase& phase_for(const Simulation& simulation, double time) {
  if (time > 0.0 || simulation.phases() == 1) return simulation.phase_at(time);
  return simulation.phase(simulation.find_limits().phase);
}

// K and C at the state itself, or at rest, where no spring is taken to be slack.
sim::Linearisation linearised(const Simulation::Phase& phase, const sim::State& state) {
  const sim::Forces& forces = phase.forces;
  if (state.time == 0.0) return forces.bound(sim::Shapes::rest).linearisation;
  sim::Linearisation linearisation(phase.structure);
  forces.linearise(state, 1.0, 0.0, sim::JacobianForm::definite, linearisation.stiffness);
  forces.linearise(state, 0.0, 1.0, sim::JacobianForm::definite, linearisation.damping);
  return linearisation;
}

Subject make_subject(const Scene& scene, const Simulation& simulation, double time) {
  const Simulation::Phase& phase = phase_for(simulation, time);
  const sim::Structure& structure = phase.structure;
  const sim::State state = state_at(simulation, time);
  sim::ForceBound any_shape = phase.forces.bound(sim::Shapes::any);
  Subject subject{scene,
                  simulation,
                  phase,
                  state,
                  linearised(phase, state),
                  std::move(any_shape.linearisation),
                  phase.forces.least_damping(),
                  std::move(any_shape.unbounded),
                  nullptr,
                  {},
                  {},
                  sim::find_step_setter(structure, phase.forces.bound(sim::Shapes::rest).linearisation.stiffness)};
  subject.k0 = sim::max_eigenvalue(structure, subject.linearisation.stiffness);
  subject.filter = phase.filter_operator();
  if (!subject.filter) return subject;
  subject.filtered = sim::filtered_eigenvalue(structure, subject.linearisation.stiffness, *subject.filter);
  return subject;
}

// "levels", or what the paper's filter acts on.
std::string_view filter_name(const sim::Filter& filter) {
  return filter.options().kernel == sim::FilterKernel::levels ? "levels" : sim::name(filter.options().target);
}

Json as_json(const Limit& limit) { return limit.step ? Json(*limit.step) : Json(); }

Json as_json(const Subject& subject, const std::vector<Row>& rows) {
  Json json = {{"k0", subject.k0.value}, {"k0_converged", subject.k0.converged}};
  json["filtered_eigenvalue"] = subject.filtered ? Json(subject.filtered->value) : Json();
  if (subject.filtered) json["filtered_eigenvalue_converged"] = subject.filtered->converged;
  json["time"] = subject.state.time;
  json["limits"] = Json::array();
  for (const Row& row : rows) {
    Json entry = {{"method", sim::name(row.method)}, {"filtered", row.filtered}};
    entry["kernel"] = row.filtered ? Json(word_of(subject.filter->options().kernel)) : Json();
    entry["target"] = row.filtered ? Json(sim::name(subject.filter->options().target)) : Json();
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

void print_table(const Subject& subject, const std::vector<Row>& rows, Progress& progress) {
  const bool has_measured = rows.front().measured.known;
  print_line("k0 = {:.6g} /s² by Lanczos ({} iterations{})", subject.k0.value, subject.k0.iterations,
             subject.k0.converged ? "" : ", NOT converged");
  if (subject.filtered)
    print_line("Algorithm 1: {:.6g} /s² with the scene's {} filter ({} iterations{})", subject.filtered->value,
               filter_name(*subject.filter), subject.filtered->iterations,
               subject.filtered->converged ? "" : ", NOT converged");
  if (subject.phase.begin > 0.0)
    print_line(""), print_line("with the pins that hold from {:g} s on", subject.phase.begin);
  print_line("");
  print_line("largest stable step [ms] at t = {:g} s", subject.state.time);
  print_line("{:<16}{:<10}{:>12}{:>12}{:>12}{:>12}", "method", "filter", "paper", "certified", "any shape",
             has_measured ? "measured" : "");
  for (const Row& row : rows)
    print_line("{:<16}{:<10}{:>12}{:>12}{:>12}{:>12}", sim::name(row.method),
               row.filtered ? filter_name(*subject.filter) : "-", shown(row.paper), shown(row.certified),
               shown(row.any_shape), shown(row.measured));
  print_text(
      "\npaper: equation 11 and Algorithm 1. certified: no growth of the linearised step at this state. any shape: "
      "the\n"
      "same for the stiffest that any fold can be. none: no limit found.\n");
  for (const std::string& law : subject.unbounded)
    progress.say(fmt::format("warning: no limit counts {}, which has no bound", law));
  if (subject.setter) progress.say("warning: " + sim::text_of(subject.phase.structure, *subject.setter));
}

}  // namespace

int stability_command(const StabilityOptions& options) {
  Progress progress(options.scene.progress);
  const Scene scene = read_scene(options.scene.scene, options.scene.overrides, progress);
  progress.phase("springs");
  const Simulation simulation(scene);
  progress.phase("limits");
  const Subject subject = make_subject(scene, simulation, options.time);
  std::vector<Row> rows = rows_of(subject);
  certify(subject, rows);
  if (options.measured) {
    progress.phase("measured limits");
    tbb::parallel_for(
        std::size_t{0}, rows.size(), [&](std::size_t r) { rows[r].measured = measured(subject, rows[r]); },
        tbb::simple_partitioner());
  }
  progress.end();
  if (options.scene.json)
    print_json(json_text(as_json(subject, rows), 2));
  else
    print_table(subject, rows, progress);
  return exit_done;
}

}  // namespace billow::cli
