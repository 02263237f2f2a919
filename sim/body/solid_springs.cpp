// Springs k with length L and direction n from a vertex pull at it, when the body is strained by e, with the force sum
// k L (n . e n) n = e : sum k L n n n. An isotropic solid with Poisson's ratio 1/4 has the stress 2/5 E (tr e + 2 e),
// so at an area vector a, outwards, it pulls with e : 2/5 E (I a and its permutations). Where the two cancel at every
// vertex, a strain that is the same everywhere leaves the body in balance with what pulls at its surface, and it is the
// solid exactly, coarse or fine: the patch test of a body that has no vertices inside.
#include "sim/body/solid_springs.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "sim/body/interior_springs.h"
#include "sim/body/membrane_springs.h"
#include "sim/body/moment_fit.h"
#include "sim/mesh/closed_surface.h"
#include "sim/mesh/face_vector.h"

namespace billow::sim {
namespace {

using Fit = MomentFit<10>;
using Pair = std::pair<int, int>;

// Of the modulus that the surface usually carries: rays cross a bent body where it is not strained, on average, so it
// bends by its surface, which has more leverage than the solid. A bar as long as eight widths then bends as it should
// within 40 %, and still pulls as it should.
constexpr double surface_share = 0.3;

constexpr double lame = 0.4;  // lambda = mu, in units of E

// The powers of x, y and z in a symmetric tensor's components, and the root of how often each stands in it.
struct Component {
  std::array<int, 3> power;
  double root;
};

const std::array<Component, 10>& components() {
  static const double r3 = std::sqrt(3.0), r6 = std::sqrt(6.0);
  static const std::array<Component, 10> list{{{{3, 0, 0}, 1.0},
                                               {{0, 3, 0}, 1.0},
                                               {{0, 0, 3}, 1.0},
                                               {{2, 1, 0}, r3},
                                               {{2, 0, 1}, r3},
                                               {{1, 2, 0}, r3},
                                               {{0, 2, 1}, r3},
                                               {{1, 0, 2}, r3},
                                               {{0, 1, 2}, r3},
                                               {{1, 1, 1}, r6}}};
  return list;
}

// n n n.
Fit::Moments cube(const Eigen::Vector3d& n) {
  Fit::Moments moments;
  for (int c = 0; c < 10; ++c) {
    const auto& [power, root] = components()[c];
    moments(c) = root * std::pow(n.x(), power[0]) * std::pow(n.y(), power[1]) * std::pow(n.z(), power[2]);
  }
  return moments;
}

// I a and its two permutations: 3 a_x at xxx, a_y at xxy, 0 at xyz.
Fit::Moments pressure(const Eigen::Vector3d& a) {
  Fit::Moments moments = Fit::Moments::Zero();
  for (int c = 0; c < 10; ++c) {
    const auto& [power, root] = components()[c];
    for (int axis = 0; axis < 3; ++axis) {
      if (power[axis] == 3) moments(c) = 3.0 * a(axis);
      if (power[axis] == 1 && root < 2.0) moments(c) = root * a(axis);
    }
  }
  return moments;
}

struct Surface {
  Eigen::MatrixX3d area_vector;  // [m^2] (v x 3) outwards, each face's in equal shares to its corners
  Eigen::VectorXd area;          // [m^2] (v)
};

Surface surface_of(const Mesh& mesh) {
  Surface surface{Eigen::MatrixX3d::Zero(mesh.vertices(), 3), Eigen::VectorXd::Zero(mesh.vertices())};
  const double outwards = enclosed_volume(mesh) < 0.0 ? -1.0 : 1.0;
  for (const Face& face : mesh.face) {
    const int corners = corner_count(face);
    const Eigen::RowVector3d vector = area_vector(mesh.position, face);
    for (int c = 0; c < corners; ++c) {
      surface.area_vector.row(face[c]) += outwards / corners * vector;
      surface.area(face[c]) += vector.norm() / corners;
    }
  }
  return surface;
}

// k L^2 [N m] (m) of a membrane of E V / S: over the section of a long body it pulls with the given share of the
// solid's modulus.
Eigen::VectorXd surface_tension(const Mesh& mesh, const Structure& body, double modulus) {
  std::vector<SpringPair> springs;
  for (int s = 0; s < body.springs(); ++s) {
    const bool outside = body.kind[s] == SpringKind::structural || body.kind[s] == SpringKind::shear;
    springs.push_back({outside ? body.kind[s] : SpringKind::bend, body.spring(s, 0), body.spring(s, 1)});
  }
  return membrane_stiffness(mesh, springs, isotropic_membrane(modulus)).cwiseProduct(body.rest_length.cwiseAbs2());
}

// The parallel lines from a vertex's area a along its ray d fill the volume |a . d|, and a solid's k L^2 is 2/5 E times
// it: then straight rays, counted half because both of their ends have one, and slanted ones hold a flat surface as a
// solid does.
Eigen::VectorXd ray_tension(const Mesh& mesh, const Structure& body, const Surface& surface, double young) {
  std::map<Pair, int> number;
  for (int s = 0; s < body.springs(); ++s) number[{body.spring(s, 0), body.spring(s, 1)}] = s;
  Eigen::VectorXd tension = Eigen::VectorXd::Zero(body.springs());
  for (const auto& [from, to, straight] : interior_rays(mesh)) {
    const double volume = std::abs(surface.area_vector.row(from).dot(mesh.position.row(to) - mesh.position.row(from)));
    tension(number.at(std::minmax(from, to))) += (straight ? 0.5 : 1.0) * lame * young * volume;
  }
  return tension;
}

Fit fit_of(const Structure& body, const Surface& surface, double young) {
  Fit fit;
  fit.cells.resize(body.particles());
  for (int v = 0; v < body.particles(); ++v)
    fit.cells[v] = {-lame * young * pressure(surface.area_vector.row(v).transpose()), surface.area(v)};
  fit.springs.resize(body.springs());
  for (int s = 0; s < body.springs(); ++s) {
    const int i = body.spring(s, 0), j = body.spring(s, 1);
    const Eigen::Vector3d way = (body.rest_position.row(j) - body.rest_position.row(i)).transpose();
    const Fit::Moments moments = cube(way.normalized()) / way.norm();
    fit.give(s, {i, moments});
    fit.give(s, {j, -moments});
  }
  return fit;
}

}  // namespace

Eigen::VectorXd solid_stiffness(const Mesh& mesh, const Structure& body, double young) {
  const Surface surface = surface_of(mesh);
  const double volume = std::abs(enclosed_volume(mesh));
  const Eigen::VectorXd outside = surface_tension(mesh, body, surface_share * young * volume / surface.area.sum());
  const Eigen::VectorXd rays = ray_tension(mesh, body, surface, young);
  // Over all directions the energy is that of sum k L^2 = 6 E V.
  const double whole = 6.0 * young * volume;
  const double scale = std::max(0.1, (whole - outside.sum()) / rays.sum());
  Fit fit = fit_of(body, surface, young);
  for (int s = 0; s < body.springs(); ++s)
    fit.springs[s].usual = body.kind[s] == SpringKind::bend && rays(s) == 0.0 ? 0.0 : outside(s) + scale * rays(s);
  fit.settle();
  Eigen::VectorXd tension(body.springs());
  for (int s = 0; s < body.springs(); ++s) tension(s) = fit.springs[s].tension;
  return (whole / tension.sum() * tension).cwiseQuotient(body.rest_length.cwiseAbs2());
}

}  // namespace billow::sim
