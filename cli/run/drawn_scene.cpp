// State -> surfaces.
#include "cli/run/drawn_scene.h"

namespace billow::cli {

DrawnScene::DrawnScene(const Scene& scene, const Simulation& simulation) : scene_(scene), simulation_(simulation) {
  for (const BodySpec& body : scene.bodies) skin_.push_back(skin_of(body));
  const Eigen::AlignedBox3d start = box(simulation.initial_state());
  for (const ColliderSpec& collider : scene.colliders) collider_.emplace_back(collider, start);
  if (scene.motes > 0) motes_.emplace(scene.motes, simulation.initial_state().position, scene.water.velocity);
}

std::vector<render::DrawnBody> DrawnScene::solids() const {
  std::vector<render::DrawnBody> drawn;
  for (std::size_t b = 0; b < skin_.size(); ++b)
    drawn.push_back({skin_[b].surface, scene_.bodies[b].texture, scene_.bodies[b].colour});
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
  if (motes_) states.push_back(motes_->at(state.time, path));
  return states;
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

// How far the followed body's centre of mass has come [m].
Eigen::Vector3d DrawnScene::camera_path(const sim::State& state) const {
  if (!scene_.followed) return Eigen::Vector3d::Zero();
  const sim::Structure& structure = simulation_.structure();
  const sim::Body& body = structure.body[*scene_.followed];
  const auto mass = structure.mass.segment(body.first_particle, body.particles);
  const Eigen::MatrixX3d way =
      (state.position - simulation_.initial_state().position).middleRows(body.first_particle, body.particles);
  return way.transpose() * mass / mass.sum();
}

}  // namespace billow::cli
