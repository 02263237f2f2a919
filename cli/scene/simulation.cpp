// Scene -> structure, forces, step.
#include "cli/scene/simulation.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_invoke.h>

#include "base/error.h"
#include "cli/scene/linearised_scene.h"
#include "cli/scene/scene_filter.h"
#include "cli/scene/scene_parts.h"
#include "sim/filter/filter.h"
#include "sim/limit/certificate.h"
#include "sim/limit/filtered_eigenvalue.h"
#include "sim/limit/measured_limit.h"
#include "sim/limit/paper_step.h"

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

}  // namespace

Simulation::Simulation(const Scene& scene)
    : scene_(scene),
      structure_(build_structure(scene)),
      forces_(std::make_unique<sim::Forces>(structure_, scene.gravity)),
      initial_(start_of(scene, structure_)) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) add_laws(scene, structure_, static_cast<int>(b), *forces_);
  operator_ = make_filter(scene, structure_, *forces_);
  if (operator_) filter_ = operator_->options();
}

sim::SolverOptions Simulation::solver_options(const StepChoice& choice) const {
  sim::SolverOptions options;
  options.method = scene_.solver.method;
  options.integrator = scene_.solver.integrator;
  options.filter = filter_;
  options.step = choice.step;
  options.limit = choice.limit;
  return options;
}

std::unique_ptr<sim::Solver> Simulation::make_solver(const StepChoice& choice) const {
  return std::make_unique<sim::Solver>(structure_, *forces_, solver_options(choice), initial_);
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
                                .energy_scale = sim::energy_scale(structure_, *forces_, scene_.gravity, initial_),
                                .stretch = stretch(scene_.solver.method, structure_),
                                .from_start = filter_ && filter_->target == sim::FilterTarget::force};
  return std::make_unique<sim::WatchedRun>(structure_, *forces_,
                                           std::make_unique<sim::Solver>(structure_, *forces_, options, initial_),
                                           watch, std::move(next_time));
}

sim::CertifiedStep Simulation::certified_limit(const sim::Linearisation& linearisation,
                                               const sim::StiffnessMatrix* least_damping) const {
  return located(scene_.file.string(), [&] {
    return sim::certified_step(linearised_step(scene_, structure_, linearisation, filter_operator(), least_damping));
  });
}

void StepChoice::take(const sim::CertifiedStep& found, std::optional<double>& limit) {
  if (!found.unlimited) limit = found.step;
  always_grows = always_grows || found.always_grows;
}

// What does not need the others' results is found side by side.
StepChoice Simulation::find_limits() const {
  const SolverSpec& solver = scene_.solver;
  StepChoice choice;
  const sim::ForceBound at_rest = forces_->bound(sim::Shapes::rest);
  choice.unbounded = at_rest.unbounded;
  sim::CertifiedStep rest, any{.unlimited = true};
  const auto find_eigenvalues = [&] {
    constexpr double reported = 1e-5;  // of the error's bound; the error itself is about its square
    choice.k0 = sim::max_eigenvalue(structure_, at_rest.linearisation.stiffness, {.tolerance = reported});
    if (operator_) choice.filtered = sim::filtered_eigenvalue(structure_, at_rest.linearisation.stiffness, *operator_);
  };
  const auto find_any = [&] {
    const sim::StiffnessMatrix least_damping = forces_->least_damping();
    any = certified_limit(forces_->bound(sim::Shapes::any).linearisation, &least_damping);
    if (sim::is_explicit(solver.method))
      choice.setter = sim::find_step_setter(structure_, at_rest.linearisation.stiffness);
  };
  oneapi::tbb::parallel_invoke(
      find_eigenvalues, [&] { rest = certified_limit(at_rest.linearisation, nullptr); },
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

// Why there is no step to take, and what to do.
std::string Simulation::refusal() const {
  const SolverSpec& solver = scene_.solver;
  if (filter_ && solver.method != sim::Method::forward_euler)
    return fmt::format(
        "this {} filter turns some motions around, so that {} grows at every step and 'step: auto' has none to offer; "
        "use 'form: conserving' or a larger lambda, or give a step in seconds",
        sim::name(filter_->target), sim::name(solver.method));
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
  if (limit && *limit == 0.0) throw InputError(scene_.file.string() + ": " + refusal());
  choice.step = limit ? solver.safety * *limit : paper_implicit_step;
  choice.bound = !limit                     ? "unlimited: the paper's 0.01 s"
                 : by_paper                 ? "paper"
                 : choice.any_shape_binds() ? "certified for any shape"
                                            : "certified at rest";
  return choice;
}

}  // namespace billow::cli
