// Scene -> structure, forces, step.
#include "cli/scene/simulation.h"

#include "base/error.h"
#include "cli/scene/particle_expression.h"
#include "sim/filter/filter.h"
#include "sim/limit/certificate.h"
#include "sim/limit/filtered_eigenvalue.h"
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

// lambda at every particle, where the scene gives a formula for it. Throws InputError located there.
std::optional<sim::FilterOptions> filter_of(const Scene& scene, const sim::Structure& structure) {
  std::optional<sim::FilterOptions> filter = scene.solver.filter;
  if (!filter || scene.solver.lambda_expression.empty()) return filter;
  filter->particle_lambda.resize(structure.particles());
  try {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const sim::Body& body = structure.body[b];
      const Eigen::MatrixX3d position = structure.rest_position.middleRows(body.first_particle, body.particles);
      filter->particle_lambda.segment(body.first_particle, body.particles) =
          evaluate_at_particles(scene.solver.lambda_expression, position, particle_mesh(scene.bodies[b]));
    }
    if (!(filter->particle_lambda.minCoeff() > 0.0)) throw InputError("lambda must be positive at every particle");
  } catch (const InputError& error) {
    throw InputError(scene.solver.lambda_where + ": " + error.what());
  }
  return filter;
}

}  // namespace

Simulation::Simulation(const Scene& scene)
    : scene_(scene),
      structure_(build_structure(scene)),
      forces_(std::make_unique<sim::Forces>(structure_, scene.gravity)),
      initial_(start_of(scene, structure_)),
      filter_(filter_of(scene, structure_)) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) add_laws(scene, structure_, static_cast<int>(b), *forces_);
}

std::unique_ptr<sim::Solver> Simulation::make_solver(const StepChoice& choice) const {
  sim::SolverOptions options;
  options.method = scene_.solver.method;
  options.integrator = scene_.solver.integrator;
  options.filter = filter_;
  options.step = choice.step;
  options.limit = choice.limit;
  return std::make_unique<sim::Solver>(structure_, *forces_, options, initial_);
}

std::optional<double> Simulation::certified_limit(const sim::Linearisation& linearisation) const {
  const SolverSpec& solver = scene_.solver;
  std::optional<sim::Filter> filter;
  if (filter_) filter.emplace(structure_, *filter_);
  const sim::CertifiedStep certified =
      sim::certified_step(structure_, linearisation, structure_.rest_position, solver.method, solver.integrator,
                          filter ? &*filter : nullptr);
  return certified.unlimited ? std::nullopt : std::make_optional(certified.step);
}

StepChoice Simulation::find_limits() const {
  const SolverSpec& solver = scene_.solver;
  StepChoice choice;
  const sim::ForceBound at_rest = forces_->bound(sim::Shapes::rest);
  choice.unbounded = at_rest.unbounded;
  choice.k0 = sim::max_eigenvalue(structure_, at_rest.linearisation.stiffness);
  if (filter_)
    choice.filtered =
        sim::filtered_eigenvalue(structure_, at_rest.linearisation.stiffness, sim::Filter(structure_, *filter_));
  choice.paper = sim::paper_step(solver.method, choice.filtered ? choice.filtered->value : choice.k0.value);
  choice.certified = certified_limit(at_rest.linearisation);
  if (choice.certified && solver.step_rule != StepRule::fixed)  // a given step is only compared with the first
    choice.any_shape = certified_limit(forces_->bound(sim::Shapes::any).linearisation);
  const bool any_shape_binds = choice.any_shape && *choice.any_shape < *choice.certified;
  choice.limit = any_shape_binds ? choice.any_shape : choice.certified;
  return choice;
}

StepChoice Simulation::choose_step() const {
  const SolverSpec& solver = scene_.solver;
  StepChoice choice = find_limits();
  const bool any_shape_binds = choice.any_shape && choice.limit == choice.any_shape;
  if (solver.step_rule == StepRule::fixed) return choice.step = solver.step, choice.bound = "given", choice;
  const bool by_paper = solver.step_rule == StepRule::paper;
  const std::optional<double> limit = by_paper ? choice.paper : choice.limit;
  if (limit && *limit == 0.0)
    throw InputError(scene_.file.string() + ": " + std::string(sim::name(solver.method)) +
                     " grows at every step here, so 'step: auto' has none to offer; add damping or a velocity filter, "
                     "use another method, or give a step in seconds");
  choice.step = limit ? solver.safety * *limit : paper_implicit_step;
  choice.bound = !limit            ? "unlimited: the paper's 0.01 s"
                 : by_paper        ? "paper"
                 : any_shape_binds ? "certified for any shape"
                                   : "certified at rest";
  return choice;
}

}  // namespace billow::cli
