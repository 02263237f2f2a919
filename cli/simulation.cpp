// Scene -> structure, forces, surfaces, step.
#include "cli/simulation.h"

#include "sim/certificate.h"
#include "sim/error.h"
#include "sim/filter.h"

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
  for (const BodySpec& body : scene.bodies) surface_.push_back(sim::build_surface(body.mesh));
}

std::vector<render::DrawnBody> Simulation::drawn_bodies() const {
  std::vector<render::DrawnBody> drawn;
  for (std::size_t b = 0; b < surface_.size(); ++b)
    drawn.push_back({surface_[b], scene_.bodies[b].texture, scene_.bodies[b].colour});
  return drawn;
}

std::vector<sim::SurfaceState> Simulation::surfaces(const sim::State& state) const {
  std::vector<sim::SurfaceState> states;
  for (const sim::Body& body : structure_.body)
    states.push_back({state.position.middleRows(body.first_particle, body.particles).cast<float>(),
                      state.velocity.middleRows(body.first_particle, body.particles).cast<float>()});
  return states;
}

std::unique_ptr<sim::Solver> Simulation::make_solver(const StepChoice& choice) const {
  sim::SolverOptions options;
  options.method = scene_.solver.method;
  options.integrator = scene_.solver.integrator;
  options.filter = scene_.solver.filter;
  options.step = choice.step;
  options.limit = choice.limit;
  return std::make_unique<sim::Solver>(structure_, *forces_, options, initial_);
}

std::optional<double> Simulation::certified_limit(const sim::Linearisation& linearisation) const {
  const SolverSpec& solver = scene_.solver;
  std::optional<sim::Filter> filter;
  if (solver.filter) filter.emplace(structure_, *solver.filter);
  const sim::CertifiedStep certified =
      sim::certified_step(structure_, linearisation, structure_.rest_position, solver.method, solver.integrator,
                          filter ? &*filter : nullptr);
  return certified.unlimited ? std::nullopt : std::make_optional(certified.step);
}

void Simulation::find_limits(StepChoice& choice) const {
  const SolverSpec& solver = scene_.solver;
  const sim::Linearisation at_rest = sim::linearise_at_rest(structure_);
  choice.k0 = sim::max_eigenvalue(structure_, at_rest.stiffness);
  if (solver.filter)
    choice.filtered = sim::filtered_eigenvalue(structure_, at_rest.stiffness, sim::Filter(structure_, *solver.filter));
  choice.paper = sim::paper_step(solver.method, choice.filtered ? choice.filtered->value : choice.k0.value);
  choice.certified = certified_limit(at_rest);
  if (choice.certified) choice.any_shape = certified_limit(sim::linearise_any_shape(structure_));
}

StepChoice Simulation::choose_step() const {
  const SolverSpec& solver = scene_.solver;
  StepChoice choice;
  find_limits(choice);
  const bool any_shape_binds = choice.any_shape && *choice.any_shape < *choice.certified;
  choice.limit = any_shape_binds ? choice.any_shape : choice.certified;
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
