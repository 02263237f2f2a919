// Scene -> structure, forces, surfaces, step.
#include "cli/simulation.h"

#include "cli/particle_expression.h"
#include "sim/certificate.h"
#include "sim/error.h"
#include "sim/filter.h"
#include "sim/fish_skin.h"
#include "sim/muscle_force.h"
#include "sim/water_force.h"

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

sim::Skin skin_of(const BodySpec& body) {
  if (!body.fish) return {sim::build_surface(body.mesh)};
  return body.mesh_file.empty() ? sim::plain_fish_skin() : sim::bind_fish_skin(body.mesh, body.fish->options.length);
}

void add_fish_forces(const Scene& scene, const sim::Structure& structure, int body, sim::Forces& forces) {
  const FishSpec& fish = *scene.bodies[body].fish;
  forces.add(std::make_unique<sim::MuscleForce>(structure, body, sim::FishMotion(fish.motion)));
  forces.add(std::make_unique<sim::WaterForce>(scene.water, sim::fish_faces(), structure.body[body].first_particle));
  forces.add(std::make_unique<sim::Buoyancy>(structure, body, scene.gravity, fish.buoyancy));
}

// The mesh whose vertices are the body's particles; an empty one for bodies that are only dressed in theirs.
const sim::Mesh& particle_mesh(const BodySpec& spec, const sim::Body& body) {
  static const sim::Mesh none;
  return spec.mesh.vertices() == body.particles ? spec.mesh : none;
}

// lambda at every particle, where the scene gives a formula for it. Throws InputError located there.
std::optional<sim::FilterOptions> filter_of(const Scene& scene, const sim::Structure& structure) {
  std::optional<sim::FilterOptions> filter = scene.solver.filter;
  if (!filter || scene.solver.lambda_expression.empty()) return filter;
  filter->lambda = 1.0;
  filter->lambda_scale.resize(structure.particles());
  try {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const sim::Body& body = structure.body[b];
      const Eigen::MatrixX3d position = structure.rest_position.middleRows(body.first_particle, body.particles);
      filter->lambda_scale.segment(body.first_particle, body.particles) =
          evaluate_at_particles(scene.solver.lambda_expression, position, particle_mesh(scene.bodies[b], body));
    }
    if (!(filter->lambda_scale.minCoeff() > 0.0)) throw InputError("lambda must be positive at every particle");
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
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    skin_.push_back(skin_of(scene.bodies[b]));
    if (scene.bodies[b].fish) add_fish_forces(scene, structure_, static_cast<int>(b), *forces_);
  }
  if (scene.motes > 0) motes_.emplace(scene.motes, initial_.position, scene.water.velocity);
}

std::vector<render::DrawnBody> Simulation::drawn_bodies() const {
  std::vector<render::DrawnBody> drawn;
  for (std::size_t b = 0; b < skin_.size(); ++b)
    drawn.push_back({skin_[b].surface, scene_.bodies[b].texture, scene_.bodies[b].colour});
  if (motes_) drawn.push_back(motes_->drawn());
  return drawn;
}

std::vector<sim::SurfaceState> Simulation::surfaces(const sim::State& state) const {
  std::vector<sim::SurfaceState> states;
  const Eigen::RowVector3f path = camera_path(state).transpose().cast<float>();
  for (std::size_t b = 0; b < skin_.size(); ++b) {
    states.push_back(sim::pose(skin_[b], structure_.body[b], state));
    states.back().position.rowwise() -= path;
  }
  if (motes_) states.push_back(motes_->at(state.time, path));
  return states;
}

// How far the followed body's centre of mass has come [m].
Eigen::Vector3d Simulation::camera_path(const sim::State& state) const {
  if (!scene_.followed) return Eigen::Vector3d::Zero();
  const sim::Body& body = structure_.body[*scene_.followed];
  const auto mass = structure_.mass.segment(body.first_particle, body.particles);
  const Eigen::MatrixX3d way = (state.position - initial_.position).middleRows(body.first_particle, body.particles);
  return way.transpose() * mass / mass.sum();
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
  const sim::Linearisation at_rest = sim::linearise_at_rest(structure_);
  choice.k0 = sim::max_eigenvalue(structure_, at_rest.stiffness);
  if (filter_)
    choice.filtered = sim::filtered_eigenvalue(structure_, at_rest.stiffness, sim::Filter(structure_, *filter_));
  choice.paper = sim::paper_step(solver.method, choice.filtered ? choice.filtered->value : choice.k0.value);
  choice.certified = certified_limit(at_rest);
  if (choice.certified && solver.step_rule != StepRule::fixed)  // a given step is only compared with the first
    choice.any_shape = certified_limit(sim::linearise_any_shape(structure_));
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
