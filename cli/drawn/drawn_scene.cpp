// State -> surfaces.
#include "cli/drawn/drawn_scene.h"

#include <algorithm>

#include "cli/drawn/painted_surface.h"
#include "sim/body/stretch.h"

namespace billow::cli {
namespace {

bool shows_strain(const std::vector<render::View>& views) {
  return std::find(views.begin(), views.end(), render::View::data) != views.end();
}

// What lies within this many of its own sizes from the world's zero is drawn from there.
constexpr double far_away = 100.0;

Eigen::Vector3d origin_for(const Eigen::MatrixX3d& position) {
  const Eigen::Vector3d low = position.colwise().minCoeff(), high = position.colwise().maxCoeff();
  const Eigen::Vector3d middle = 0.5 * (low + high);
  const bool far = middle.cwiseAbs().maxCoeff() > far_away * (high - low).norm();
  return far ? middle : Eigen::Vector3d::Zero();
}

// The box around what of a body a picture should show.
Eigen::AlignedBox3d framed_box(const sim::SurfaceState& surface, const std::vector<int>& framed_points) {
  if (framed_points.empty()) return box_of(surface);
  return box_of({surface.position(framed_points, Eigen::all), {}});
}

}  // namespace

DrawnScene::DrawnScene(const Scene& scene, const Simulation& simulation)
    : scene_(scene),
      simulation_(simulation),
      origin_(origin_for(simulation.initial_state().position)),
      wants_strain_(shows_strain(scene.render.views)) {
  for (const BodySpec& body : scene.bodies) skin_.push_back(skin_of(body));
  const Eigen::AlignedBox3d start = box(simulation.initial_state());
  for (const ColliderSpec& collider : scene.colliders) collider_.emplace_back(collider, start);
  if (scene.motes > 0)
    motes_.emplace(scene.motes, simulation.initial_state().position.rowwise() - origin_.transpose(),
                   scene.water.velocity);
}

std::vector<render::DrawnBody> DrawnScene::solids() const {
  std::vector<render::DrawnBody> drawn;
  for (std::size_t b = 0; b < skin_.size(); ++b)
    drawn.push_back({painted(skin_[b].surface, scene_.bodies[b].mesh, scene_.bodies[b]), scene_.bodies[b].finish,
                     simulation_.structure().body[b].name});
  for (const DrawnCollider& collider : collider_) drawn.push_back(collider.drawn());
  return drawn;
}

std::vector<render::DrawnBody> DrawnScene::bodies() const {
  std::vector<render::DrawnBody> drawn = solids();
  if (motes_) drawn.push_back(motes_->drawn());
  return drawn;
}

std::vector<sim::SurfaceState> DrawnScene::solids_from(const Eigen::Vector3d& origin, const sim::State& state) const {
  std::vector<sim::SurfaceState> states = skins_at(state, origin);
  for (const DrawnCollider& collider : collider_) states.push_back(collider.at(state.time, origin));
  return states;
}

std::vector<sim::SurfaceState> DrawnScene::solid_surfaces(const sim::State& state) const {
  return solids_from(origin_, state);
}

std::vector<sim::SurfaceState> DrawnScene::surfaces(const sim::State& state) const {
  const Eigen::Vector3d path = camera_path(state);
  std::vector<sim::SurfaceState> states = solids_from(origin_ + path, state);
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

std::vector<sim::SurfaceState> DrawnScene::skins_at(const sim::State& state, const Eigen::Vector3d& origin) const {
  std::vector<sim::SurfaceState> states;
  for (std::size_t b = 0; b < skin_.size(); ++b)
    states.push_back(sim::pose(skin_[b], simulation_.structure().body[b], state, origin));
  return states;
}

Eigen::AlignedBox3d DrawnScene::box(const sim::State& state) const {
  const std::vector<sim::SurfaceState> drawn = surfaces(state);
  Eigen::AlignedBox3d bodies;
  for (std::size_t b = 0; b < skin_.size(); ++b) bodies.extend(framed_box(drawn[b], scene_.bodies[b].framed_points));
  Eigen::AlignedBox3d box = bodies;
  for (std::size_t c = 0; c < collider_.size(); ++c) box.extend(collider_[c].framed(drawn[skin_.size() + c], bodies));
  return box.translate(origin_);
}

render::Settings DrawnScene::settings() const { return render::seen_from(scene_.render, origin_); }

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
