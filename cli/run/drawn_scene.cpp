// State -> surfaces.
#include "cli/run/drawn_scene.h"

#include <algorithm>

#include "sim/body/stretch.h"

namespace billow::cli {
namespace {

bool shows_strain(const std::vector<render::View>& views) {
  return std::find(views.begin(), views.end(), render::View::data) != views.end();
}

}  // namespace

DrawnScene::DrawnScene(const Scene& scene, const Simulation& simulation)
    : scene_(scene), simulation_(simulation), wants_strain_(shows_strain(scene.render.views)) {
  for (const BodySpec& body : scene.bodies) skin_.push_back(skin_of(body));
  const Eigen::AlignedBox3d start = box(simulation.initial_state());
  for (const ColliderSpec& collider : scene.colliders) collider_.emplace_back(collider, start);
  if (scene.motes > 0) motes_.emplace(scene.motes, simulation.initial_state().position, scene.water.velocity);
}

std::vector<render::DrawnBody> DrawnScene::solids() const {
  std::vector<render::DrawnBody> drawn;
  for (std::size_t b = 0; b < skin_.size(); ++b)
    drawn.push_back(
        {skin_[b].surface, scene_.bodies[b].texture, scene_.bodies[b].colour, simulation_.structure().body[b].name});
  for (const DrawnCollider& collider : collider_) drawn.push_back(collider.drawn());
  return drawn;
}

std::vector<render::DrawnBody> DrawnScene::bodies() const {
  std::vector<render::DrawnBody> drawn = solids();
  if (motes_) drawn.push_back(motes_->drawn());
  return drawn;
}

std::vector<sim::SurfaceState> DrawnScene::solids_from(const Eigen::RowVector3f& path, const sim::State& state) const {
  std::vector<sim::SurfaceState> states = skins_at(state);
  for (sim::SurfaceState& skin : states) skin.position.rowwise() -= path;
  for (const DrawnCollider& collider : collider_) states.push_back(collider.at(state.time, path));
  return states;
}

std::vector<sim::SurfaceState> DrawnScene::solid_surfaces(const sim::State& state) const {
  return solids_from(Eigen::RowVector3f::Zero(), state);
}

std::vector<sim::SurfaceState> DrawnScene::surfaces(const sim::State& state) const {
  const Eigen::RowVector3f path = camera_path(state).transpose().cast<float>();
  std::vector<sim::SurfaceState> states = solids_from(path, state);
  if (wants_strain_) add_strain(state, states);
  if (motes_) states.push_back(motes_->at(state.time, path));
  return states;
}

void DrawnScene::add_strain(const sim::State& state, std::vector<sim::SurfaceState>& surfaces) const {
  const sim::Structure& structure = simulation_.structure();
  const Eigen::VectorXd strain = sim::strain_of(structure, state);
  for (std::size_t b = 0; b < skin_.size(); ++b)
    surfaces[b].strain = sim::at_points(skin_[b], structure.body[b], strain);
}

std::vector<sim::SurfaceState> DrawnScene::skins_at(const sim::State& state) const {
  std::vector<sim::SurfaceState> states;
  for (std::size_t b = 0; b < skin_.size(); ++b)
    states.push_back(sim::pose(skin_[b], simulation_.structure().body[b], state));
  return states;
}

Eigen::AlignedBox3d DrawnScene::box(const sim::State& state) const {
  const std::vector<sim::SurfaceState> drawn = surfaces(state);
  Eigen::AlignedBox3d bodies;
  for (std::size_t b = 0; b < skin_.size(); ++b) bodies.extend(box_of(drawn[b]));
  Eigen::AlignedBox3d box = bodies;
  for (std::size_t c = 0; c < collider_.size(); ++c) box.extend(collider_[c].framed(drawn[skin_.size() + c], bodies));
  return box;
}

Eigen::Vector3d DrawnScene::camera_velocity(const sim::State& state) const { return followed_mean(state.velocity); }

// How far the followed body's centre of mass has come [m].
Eigen::Vector3d DrawnScene::camera_path(const sim::State& state) const {
  if (!scene_.followed) return Eigen::Vector3d::Zero();
  return followed_mean(state.position - simulation_.initial_state().position);
}

// The mean of rows (n x 3) over the followed body's particles by mass; zero where none is followed.
Eigen::Vector3d DrawnScene::followed_mean(const Eigen::MatrixX3d& of_particles) const {
  if (!scene_.followed) return Eigen::Vector3d::Zero();
  const sim::Structure& structure = simulation_.structure();
  const sim::Body& body = structure.body[*scene_.followed];
  const auto mass = structure.mass.segment(body.first_particle, body.particles);
  const Eigen::MatrixX3d rows = of_particles.middleRows(body.first_particle, body.particles);
  return rows.transpose() * mass / mass.sum();
}

}  // namespace billow::cli
