// State -> vertices of files.
#include "cli/run/cache_geometry.h"

#include "sim/body/stretch.h"
#include "sim/contact/touching.h"

namespace billow::cli {

namespace {

// Numbers of a mesh's vertices, its file's loose ones having zeros.
template <class Rows>
Rows spread(const sim::FileLayout& layout, const Rows& of_mesh) {
  return layout.spread(of_mesh, Rows(Rows::Zero(layout.loose.rows(), of_mesh.cols())));
}

}  // namespace

CacheGeometry::CacheGeometry(const Run& run) : simulation_(run.simulation), drawn_(run.drawn) {
  for (const BodySpec& body : run.scene.bodies)
    mesh_.push_back({body.name, sim::file_layout(body.mesh_file.empty() ? touching_mesh(body) : body.mesh), {}});
  for (std::size_t c = 0; c < run.scene.colliders.size(); ++c)
    mesh_.push_back({run.scene.colliders[c].solid.name, sim::file_layout(drawn_.colliders()[c].mesh()), {}});
  const std::vector<CacheFrame> start = at(1, 0.0, simulation_.initial_state());
  for (std::size_t m = 0; m < mesh_.size(); ++m) mesh_[m].rest = start[m].position;
}

std::vector<CacheFrame> CacheGeometry::at(long number, double time, const sim::State& state) const {
  std::vector<CacheFrame> frames;
  add_body_frames(state, frames);
  add_collider_frames(state, frames);
  for (CacheFrame& frame : frames) frame.number = number, frame.time = time;
  return frames;
}

void CacheGeometry::add_body_frames(const sim::State& state, std::vector<CacheFrame>& frames) const {
  const sim::Structure& structure = simulation_.structure();
  const std::optional<sim::ContactModel>& contact = simulation_.phase_at(state.time).contact;
  const Eigen::VectorXd strain = sim::strain_of(structure, state);
  const Eigen::VectorXd touches =
      contact ? sim::touching(*contact, state) : Eigen::VectorXd(Eigen::VectorXd::Zero(structure.particles()));
  const std::vector<sim::SurfaceState> skins = drawn_.skins_at(state);
  for (std::size_t b = 0; b < skins.size(); ++b) {
    const sim::FileLayout& layout = mesh_[b].layout;
    const auto scalars = [&](const Eigen::VectorXd& of_particles) {
      return spread(layout, sim::at_points(drawn_.skins()[b], structure.body[b], of_particles));
    };
    CacheFrame frame;
    frame.position = layout.spread(skins[b].position, Eigen::MatrixX3f(layout.loose.cast<float>()));
    frame.velocity = spread(layout, skins[b].velocity);
    frame.strain = scalars(strain);
    frame.contact = scalars(touches);
    frames.push_back(std::move(frame));
  }
}

void CacheGeometry::add_collider_frames(const sim::State& state, std::vector<CacheFrame>& frames) const {
  for (const DrawnCollider& collider : drawn_.colliders()) {
    const sim::FileLayout& layout = mesh_[frames.size()].layout;
    const sim::SurfaceState carried =
        collider.carried(layout.spread(collider.mesh().position, layout.loose), state.time);
    const Eigen::VectorXf zeros = Eigen::VectorXf::Zero(layout.vertices());
    frames.push_back({1, 0.0, carried.position, carried.velocity, zeros, zeros});
  }
}

}  // namespace billow::cli
