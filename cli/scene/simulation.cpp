// Scene -> structure, forces, step.
#include "cli/scene/simulation.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "cli/scene/linearised_scene.h"
#include "cli/scene/scene_filter.h"
#include "cli/scene/scene_parts.h"
#include "cli/scene/scene_pins.h"
#include "sim/contact/start_check.h"
#include "sim/filter/filter.h"
#include "sim/limit/certificate.h"
#include "sim/limit/filtered_eigenvalue.h"
#include "sim/limit/measured_limit.h"
#include "sim/limit/paper_step.h"
#include "sim/step/strain_limit.h"

namespace billow::cli {

namespace {

// The implicit schemes' step in the paper (section 7.2), where nothing else bounds it.
constexpr double paper_implicit_step = 0.01;

sim::State start_of(const Scene& scene, const sim::Structure& structure) {
  sim::State state = sim::rest_state(structure);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const sim::Body& body = structure.body[b];
    state.velocity.middleRows(body.first_particle, body.particles).rowwise() =
        scene.bodies[b].initial_velocity.transpose();
  }
  return state;
}

// [rest lengths] of each body, infinite for none; empty where none is limited.
std::vector<double> strain_limits(const Scene& scene) {
  std::vector<double> limit;
  for (const BodySpec& body : scene.bodies) limit.push_back(most_strain(body).value_or(INFINITY));
  const bool any = std::any_of(limit.begin(), limit.end(), [](double l) { return std::isfinite(l); });
  return any ? limit : std::vector<double>{};
}

}  // namespace

Simulation::Phase::Phase(const Scene& scene, double begin_time, sim::Structure its_structure)
    : begin(begin_time), structure(std::move(its_structure)), forces(structure, scene.gravity) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) add_laws(scene, structure, static_cast<int>(b), forces);
  built_filter = make_filter(scene, structure, forces);
  if (built_filter) filter = built_filter->options();
  if (scene.contact) contact.emplace(structure, *scene.contact);
}

Simulation::Simulation(const Scene& scene) : scene_(scene) {
  phases_.push_back(std::make_unique<Phase>(scene, 0.0, build_structure(scene)));
  for (const double time : release_times(scene))
    phases_.push_back(std::make_unique<Phase>(scene, time, released(scene, structure(), time)));
  initial_ = start_of(scene, structure());
  check_contact_at_start();
}

// Found at the mesh of the body that is in the way.
void Simulation::check_contact_at_start() const {
  if (!phase().contact) return;
  try {
    sim::check_start(*phase().contact, initial_);
  } catch (const sim::StartError& error) {
    const std::string& where = scene_.bodies[static_cast<std::size_t>(error.body)].mesh_where;
    fail_at(where.empty() ? scene_.file.string() : where, error.what());
  }
}

const Simulation::Phase& Simulation::phase_at(double time) const {
  const auto later = std::find_if(phases_.begin() + 1, phases_.end(), [&](const auto& p) { return p->begin > time; });
  return **(later - 1);
}

std::vector<sim::HookMaker> Simulation::hooks(const Phase& phase) const {
  std::vector<sim::HookMaker> makers;
  std::vector<sim::MovingPin> pins = moving_pins(scene_, phase.structure, phase.begin);
  if (!pins.empty())
    makers.push_back([&phase, pins = std::move(pins)] {
      return std::make_unique<sim::MovingPins>(phase.structure, phase.forces, pins);
    });
  if (const std::vector<double> limit = strain_limits(scene_); !limit.empty())
    makers.push_back([&phase, limit] { return std::make_unique<sim::StrainLimit>(phase.structure, limit); });
  if (phase.contact) makers.push_back([&phase] { return std::make_unique<sim::Contact>(*phase.contact); });
  return makers;
}

sim::SolverOptions Simulation::solver_options(const StepChoice& choice) const {
  sim::SolverOptions options;
  options.method = scene_.solver.method;
  options.integrator = scene_.solver.integrator;
  options.filter = phase().filter;
  options.hooks = hooks(phase());
  for (int p = 1; p < phases(); ++p)
    options.releases.push_back({.time = phase(p).begin,
                                .structure = &phase(p).structure,
                                .forces = &phase(p).forces,
                                .filter = phase(p).filter,
                                .hooks = hooks(phase(p))});
  options.step = choice.step;
  options.limit = choice.limit;
  return options;
}

std::unique_ptr<sim::Solver> Simulation::make_solver(const StepChoice& choice) const {
  return std::make_unique<sim::Solver>(structure(), forces(), solver_options(choice), initial_);
}

namespace {

// Steps from one look at the energy to the next. A look costs a step or two, which large cloths take seldom; implicit
// steps are long.
int stretch(sim::Method method, const sim::Structure& structure) {
  constexpr int few_springs = 5000;
  return !sim::is_explicit(method) ? 4 : structure.springs() <= few_springs ? 16 : 64;
}

}  // namespace

std::unique_ptr<sim::WatchedRun> Simulation::make_run(const StepChoice& choice,
                                                      sim::WatchedRun::NextTime next_time) const {
  sim::SolverOptions options = solver_options(choice);
  options.max_strain = sim::torn_strain;
  const sim::WatchOptions watch{.changes_step = scene_.solver.watch,
                                .energy_scale = sim::energy_scale(structure(), forces(), scene_.gravity, initial_),
                                .stretch = stretch(scene_.solver.method, structure()),
                                .from_start = options.filter && options.filter->target == sim::FilterTarget::force};
  return std::make_unique<sim::WatchedRun>(structure(), forces(),
                                           std::make_unique<sim::Solver>(structure(), forces(), options, initial_),
                                           watch, std::move(next_time));
}

sim::CertifiedStep Simulation::certified_limit(const Phase& phase, const sim::Linearisation& linearisation,
                                               const sim::StiffnessMatrix* least_damping) const {
  return located(scene_.file.string(), [&] {
    return sim::certified_step(
        linearised_step(scene_, phase.structure, linearisation, phase.filter_operator(), least_damping));
  });
}

void StepChoice::take(const sim::CertifiedStep& found, std::optional<double>& limit) {
  if (!found.unlimited) limit = found.step;
  always_grows = always_grows || found.always_grows;
}

// What does not need the others' results is found side by side.
StepChoice Simulation::find_limits(const Phase& phase) const {
  const SolverSpec& solver = scene_.solver;
  StepChoice choice;
  const sim::ForceBound at_rest = phase.forces.bound(sim::Shapes::rest);
  choice.unbounded = at_rest.unbounded;
  sim::CertifiedStep rest, any{.unlimited = true};
  const auto find_eigenvalues = [&] {
    constexpr double reported = 1e-5;  // of the error's bound; the error itself is about its square
    const sim::StiffnessMatrix& stiffness = at_rest.linearisation.stiffness;
    choice.k0 = sim::max_eigenvalue(phase.structure, stiffness, {.tolerance = reported});
    if (phase.built_filter) choice.filtered = sim::filtered_eigenvalue(phase.structure, stiffness, *phase.built_filter);
  };
  const auto find_any = [&] {
    const sim::StiffnessMatrix least_damping = phase.forces.least_damping();
    any = certified_limit(phase, phase.forces.bound(sim::Shapes::any).linearisation, &least_damping);
    if (sim::is_explicit(solver.method))
      choice.setter = sim::find_step_setter(phase.structure, at_rest.linearisation.stiffness);
  };
  oneapi::tbb::parallel_invoke(
      find_eigenvalues, [&] { rest = certified_limit(phase, at_rest.linearisation, nullptr); },
      [&] {
        if (solver.step_rule != StepRule::fixed) find_any();  // a given step is only compared with the first
      });
  choice.paper = sim::paper_step(solver.method, choice.filtered ? choice.filtered->value : choice.k0.value);
  choice.take(rest, choice.certified);
  choice.take(any, choice.any_shape);
  choice.only_at_rest =
      solver.method == sim::Method::forward_euler && choice.any_shape == 0.0 && choice.certified != 0.0;
  choice.limit = choice.any_shape_binds() ? choice.any_shape : choice.certified;
  return choice;
}

namespace {

// What a step by `rule` may not exceed; infinite where there is no limit.
double bound_of(const StepChoice& choice, StepRule rule) {
  return (rule == StepRule::paper ? choice.paper : choice.limit).value_or(INFINITY);
}

}  // namespace

StepChoice Simulation::find_limits() const {
  const StepRule rule = scene_.solver.step_rule;
  StepChoice least = find_limits(phase());
  bool always_grows = least.always_grows;
  for (int p = 1; p < phases(); ++p) {
    StepChoice choice = find_limits(phase(p));
    choice.phase = p;
    always_grows = always_grows || choice.always_grows;
    if (bound_of(choice, rule) < bound_of(least, rule)) least = std::move(choice);
  }
  least.always_grows = always_grows;
  return least;
}

// Why there is no step to take, and what to do.
std::string Simulation::refusal(const Phase& phase) const {
  const SolverSpec& solver = scene_.solver;
  if (phase.filter && solver.method != sim::Method::forward_euler)
    return fmt::format(
        "this {} filter turns some motions around, so that {} grows at every step and 'step: auto' has none to offer; "
        "use 'form: conserving' or a larger lambda, or give a step in seconds",
        sim::name(phase.filter->target), sim::name(solver.method));
  return fmt::format(
      "{} grows at every step here, so 'step: auto' has none to offer; add damping or a velocity filter, use another "
      "method, or give a step in seconds",
      sim::name(solver.method));
}

StepChoice Simulation::choose_step() const {
  const SolverSpec& solver = scene_.solver;
  StepChoice choice = find_limits();
  if (solver.step_rule == StepRule::fixed) return choice.step = solver.step, choice.bound = "given", choice;
  const bool by_paper = solver.step_rule == StepRule::paper;
  const std::optional<double> limit = by_paper ? choice.paper : choice.limit;
  if (limit && *limit == 0.0) throw InputError(scene_.file.string() + ": " + refusal(phase(choice.phase)));
  choice.step = limit ? solver.safety * *limit : paper_implicit_step;
  choice.bound = !limit                     ? "unlimited: the paper's 0.01 s"
                 : by_paper                 ? "paper"
                 : choice.any_shape_binds() ? "certified for any shape"
                                            : "certified at rest";
  return choice;
}

}  // namespace billow::cli
