// Collider -> surface.
#include "cli/drawn/drawn_collider.h"

#include <numbers>

#include "cli/drawn/painted_surface.h"
#include "sim/mesh/creases.h"

namespace billow::cli {
namespace {

constexpr double crease = 40.0 * std::numbers::pi / 180.0;  // [rad] edges that turn more are drawn sharp
constexpr double plane_reach = 4.0;                         // half a plane's side, in diagonals of the bodies' box
constexpr double near_share = 0.25;                         // of that diagonal: what is nearer belongs into the picture

// Two directions in the plane such that right x up = normal: a wall's up is the world's, a floor's is away (-z).
Eigen::Matrix<double, 3, 2> right_and_up(const Eigen::Vector3d& normal) {
  Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(normal);
  if (right.norm() < 1e-6) right = Eigen::Vector3d::UnitX();
  right.normalize();
  Eigen::Matrix<double, 3, 2> axes;
  axes << right, normal.cross(right);
  return axes;
}

sim::Mesh square(const sim::HalfSpace& plane, const Eigen::AlignedBox3d& bodies) {
  const Eigen::Matrix<double, 3, 2> axes = right_and_up(plane.normal);
  const Eigen::Vector2d middle = axes.transpose() * (bodies.center() - plane.point);
  const double half = plane_reach * bodies.diagonal().norm();
  sim::Mesh mesh;
  mesh.position.resize(4, 3);
  mesh.uv.resize(1);
  const Eigen::Vector2d whole_tiles = 1024.0 * (middle / 1024.0).array().floor();  // small numbers for single precision
  const Eigen::Vector2d corners[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int c = 0; c < 4; ++c) {
    const Eigen::Vector2d place = middle + half * corners[c];
    mesh.position.row(c) = plane.point + axes * place;
    mesh.uv[0][c] = (place - whole_tiles).cast<float>();
  }
  mesh.face = {{0, 1, 2, 3}};
  return mesh;
}

}  // namespace

DrawnCollider::DrawnCollider(const ColliderSpec& spec, const Eigen::AlignedBox3d& bodies) : spec_(spec) {
  const sim::Collider& solid = spec.solid;
  if (solid.half_space) square_ = square(*solid.half_space, bodies);
  const sim::Mesh drawn = solid.half_space ? square_ : sim::split_at_creases(solid.mesh, crease);
  position_ = drawn.position;
  surface_ = painted(sim::build_surface(drawn), drawn, spec);
}

sim::SurfaceState DrawnCollider::carried(const Eigen::MatrixX3d& points, double time,
                                         const Eigen::Vector3d& origin) const {
  const Eigen::Affine3d place = Eigen::Translation3d(-origin) * Eigen::Affine3d(spec_.solid.motion.at(time));
  const Eigen::Affine3d velocity = spec_.solid.motion.velocity_at(time);
  const auto mapped = [&](const auto& map) -> Eigen::MatrixX3f {
    const Eigen::MatrixX3d rows = points * map.linear().transpose();
    return (rows.rowwise() + map.translation().transpose()).template cast<float>();
  };
  return {mapped(place), mapped(velocity)};
}

Eigen::AlignedBox3d DrawnCollider::framed(const sim::SurfaceState& state, const Eigen::AlignedBox3d& bodies) const {
  if (spec_.solid.half_space) return {};
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(near_share * bodies.diagonal().norm());
  const Eigen::AlignedBox3d whole = box_of(state);
  const Eigen::AlignedBox3d near = whole.intersection({bodies.min() - margin, bodies.max() + margin});
  if (near.isEmpty()) return {};
  const bool small = whole.diagonal().norm() <= bodies.diagonal().norm();
  return small ? whole : near;
}

Eigen::AlignedBox3d box_of(const sim::SurfaceState& state) {
  Eigen::AlignedBox3d box;
  box.extend(state.position.colwise().minCoeff().transpose().cast<double>());
  box.extend(state.position.colwise().maxCoeff().transpose().cast<double>());
  return box;
}

}  // namespace billow::cli
