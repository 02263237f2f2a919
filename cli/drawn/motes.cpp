// Octahedra in a box that wraps around.
#include "cli/drawn/motes.h"

#include <cmath>

#include "base/random.h"

namespace billow::cli {
namespace {

constexpr float reach = 1.5f;             // the box extends the bodies' by this many of its diagonals
constexpr float relative_size = 0.0025f;  // radius, in diagonals of the bodies' box
constexpr int corners = 6, faces = 8;

Eigen::Matrix<float, corners, 3> octahedron() {
  Eigen::Matrix<float, corners, 3> points;
  points << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  return points;
}

// One from each pair of opposite corners; an odd number of far corners turns the order around.
Eigen::Matrix<int, faces, 3> octahedron_faces() {
  Eigen::Matrix<int, faces, 3> face;
  for (int f = 0; f < faces; ++f) {
    const int x = f & 1, y = (f >> 1) & 1, z = (f >> 2) & 1;
    const bool odd = ((x + y + z) & 1) != 0;
    face.row(f) << x, odd ? 4 + z : 2 + y, odd ? 2 + y : 4 + z;
  }
  return face;
}

}  // namespace

Motes::Motes(int count, const Eigen::MatrixX3d& position, const Eigen::Vector3d& current)
    : current_(current.transpose().cast<float>()) {
  constexpr std::uint64_t seed = 23;
  box_.extend(position.colwise().minCoeff().transpose().cast<float>());
  box_.extend(position.colwise().maxCoeff().transpose().cast<float>());
  const float size = box_.diagonal().norm();
  radius_ = relative_size * size;
  const Eigen::Vector3f margin = Eigen::Vector3f::Constant(reach * size);
  box_ = {box_.min() - margin, box_.max() + margin};
  const Eigen::Array<float, Eigen::Dynamic, 3> share = 0.5f * (seeded_noise(count, seed).cast<float>().array() + 1.0f);
  middle_ = (share.rowwise() * box_.sizes().transpose().array()).rowwise() + box_.min().transpose().array();
}

render::DrawnBody Motes::drawn() const {
  const auto count = static_cast<int>(middle_.rows());
  render::DrawnBody body;
  body.finish[0].colour = {0.75f, 0.85f, 0.85f};
  body.name = "motes";
  body.scenery = true;  // they all move alike, and would be in the way of what is to be read
  body.surface.triangle.resize(faces * count, 3);
  for (int m = 0; m < count; ++m)
    body.surface.triangle.middleRows<faces>(faces * m) = octahedron_faces().array() + corners * m;
  body.surface.point = Eigen::VectorXi::LinSpaced(corners * count, 0, corners * count - 1);
  body.surface.uv = Eigen::MatrixX2f::Zero(corners * count, 2);
  return body;
}

sim::SurfaceState Motes::at(double time, const Eigen::Vector3d& path) const {
  const Eigen::Array<float, corners, 3> shape = radius_ * octahedron().array();
  const Eigen::RowVector3f drift = static_cast<float>(time) * current_ - path.transpose().cast<float>();
  sim::SurfaceState state;
  state.position.resize(corners * middle_.rows(), 3);
  state.velocity = current_.replicate(corners * middle_.rows(), 1);
  for (Eigen::Index m = 0; m < middle_.rows(); ++m) {
    Eigen::RowVector3f place = middle_.row(m) + drift - box_.min().transpose();
    for (int axis = 0; axis < 3; ++axis)
      place(axis) -= box_.sizes()(axis) * std::floor(place(axis) / box_.sizes()(axis));
    place += box_.min().transpose();
    state.position.middleRows<corners>(corners * m) = shape.matrix().rowwise() + place;
  }
  return state;
}

}  // namespace billow::cli
