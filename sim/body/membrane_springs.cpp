// A spring of stiffness k, length L and direction n = (cos a, sin a), of which a length l lies in a face, has there the
// energy 1/2 k L l (n . strain n)^2: it is the face's through the moments k L l (1, e^2ia, e^4ia), and the sum of these
// is all that a strain can tell of a face's springs. Where every face has the membrane's moments, a strain that is the
// same everywhere leaves every inner vertex in balance (the patch test), and the sheet is the membrane exactly.
#include "sim/body/membrane_springs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/body/moment_fit.h"
#include "sim/mesh/face_vector.h"
#include "sim/mesh/mesh_edges.h"

namespace billow::sim {
namespace {

// (1, cos 2a, sin 2a, cos 4a, sin 4a), each times the root of its weight in the product of two tensors n n n n:
// cos^4 d = 3/8 + 1/2 cos 2d + 1/8 cos 4d.
using MembraneFit = MomentFit<5>;
using MembraneMoments = MembraneFit::Moments;

MembraneMoments moments(double angle) {
  const double mean = std::sqrt(0.375), second = std::sqrt(0.5), fourth = std::sqrt(0.125);
  return {mean, second * std::cos(2 * angle), second * std::sin(2 * angle), fourth * std::cos(4 * angle),
          fourth * std::sin(4 * angle)};
}

// A face laid flat: its area, its axes (the first along its threads), and what its springs' moments should be.
struct FlatFace {
  double area = 0.0;  // [m^2]
  Eigen::Vector3d first, second;
  MembraneMoments wanted;  // [N m]

  double angle(const Eigen::Vector3d& way) const { return std::atan2(second.dot(way), first.dot(way)); }
};

// Between the middles of a quad's sides, in the mean of both directions; of triangles any edge serves.
Eigen::Vector3d thread(const Mesh& mesh, const Face& face, const Eigen::Vector3d& normal) {
  const auto corner = [&](int c) -> Eigen::Vector3d { return mesh.position.row(face[c]); };
  if (corner_count(face) == 3) return (corner(1) - corner(0)).normalized();
  const Eigen::Vector3d along = (corner(1) + corner(2) - corner(0) - corner(3)).normalized();
  const Eigen::Vector3d across = (corner(2) + corner(3) - corner(0) - corner(1)).normalized();
  return (along + across.cross(normal)).normalized();
}

// A square grid's: 2 k + 4 K, k of its edges in the directions 0 and 90 degrees, K of its diagonals halfway between.
FlatFace flat_face(const Mesh& mesh, const Face& face, const MembraneModuli& moduli) {
  const Eigen::Vector3d vector = area_vector(mesh.position, face).transpose();
  FlatFace flat;
  flat.area = vector.norm();
  const Eigen::Vector3d normal = vector / flat.area;
  flat.first = thread(mesh, face, normal);
  flat.second = normal.cross(flat.first).normalized();
  const double edges = edge_stiffness(moduli), pi_4 = std::atan(1.0);
  flat.wanted =
      flat.area * (edges * (moments(0.0) + moments(2 * pi_4)) + 2.0 * moduli.shear * (moments(pi_4) + moments(-pi_4)));
  return flat;
}

// The part of a spring that lies in one face.
struct Part {
  int face;
  double share;  // of its length
};

using Parts = std::vector<Part>;

// An edge lies in all its faces alike; a diagonal in its quad; a spring across an edge in both triangles, which it
// crosses by their heights over that edge, so by their areas.
std::map<std::pair<int, int>, Parts> parts_of_pairs(const Mesh& mesh, const std::vector<FlatFace>& flat) {
  std::map<std::pair<int, int>, Parts> parts;
  for (const Edge& edge : distinct_edges(mesh)) {
    Parts& of_edge = parts[{edge.first, edge.second}];
    for (const int face : edge.face) of_edge.push_back({face, 1.0 / static_cast<double>(edge.face.size())});
    if (edge.face.size() < 2) continue;
    const int left = edge.face[0], right = edge.face[1];
    const Face &a = mesh.face[left], &b = mesh.face[right];
    if (corner_count(a) != 3 || corner_count(b) != 3) continue;
    const int far_left = a[0] + a[1] + a[2] - edge.first - edge.second;
    const int far_right = b[0] + b[1] + b[2] - edge.first - edge.second;
    const double whole = flat[left].area + flat[right].area;
    parts.insert(
        {std::minmax(far_left, far_right), {{left, flat[left].area / whole}, {right, flat[right].area / whole}}});
  }
  for (int f = 0; f < static_cast<int>(mesh.face.size()); ++f) {
    const Face& face = mesh.face[f];
    if (corner_count(face) != 4) continue;
    parts[std::minmax(face[0], face[2])] = {{f, 1.0}};
    parts[std::minmax(face[1], face[3])] = {{f, 1.0}};
  }
  return parts;
}

Eigen::Vector3d way(const Mesh& mesh, const SpringPair& spring) {
  return (mesh.position.row(spring.second) - mesh.position.row(spring.first)).transpose();
}

// Sets what springs would have where all of a face's had alike.
void spread_evenly(MembraneFit& fit) {
  std::vector<double> lengths(fit.cells.size(), 0.0);  // of springs in a face, in lengths of their own
  for (const MembraneFit::Spring& s : fit.springs)
    for (const auto& [face, given] : s.shares) lengths[face] += given(0);
  for (MembraneFit::Spring& s : fit.springs)
    for (const auto& [face, given] : s.shares) s.usual += given(0) * fit.cells[face].missing(0) / lengths[face];
  for (MembraneFit::Spring& s : fit.springs) s.usual /= moments(0.0)(0);
}

// Every face is a cell, and a spring with k L^2 = 1 gives it the moments of its direction times its share.
MembraneFit fit_of(const Mesh& mesh, const std::vector<SpringPair>& springs, const std::vector<FlatFace>& faces) {
  MembraneFit fit;
  for (const FlatFace& face : faces) fit.cells.push_back({face.wanted, face.area});
  fit.springs.resize(springs.size());
  const auto parts = parts_of_pairs(mesh, faces);
  for (int s = 0; s < static_cast<int>(springs.size()); ++s) {
    if (springs[s].kind == SpringKind::bend) continue;
    for (const auto& [face, share] : parts.at({springs[s].first, springs[s].second}))
      if (faces[face].area > 0.0) fit.give(s, {face, share * moments(faces[face].angle(way(mesh, springs[s])))});
  }
  spread_evenly(fit);
  return fit;
}

}  // namespace

// With springs k along edges and K along diagonals the sheet has the shear modulus K, and a strip of it the modulus
// E = c - K^2 / c, c = k + K.
double edge_stiffness(const MembraneModuli& moduli) {
  return 0.5 * (moduli.stretch + std::hypot(moduli.stretch, 2.0 * moduli.shear)) - moduli.shear;
}

Eigen::VectorXd membrane_stiffness(const Mesh& mesh, const std::vector<SpringPair>& springs,
                                   const MembraneModuli& moduli) {
  std::vector<FlatFace> faces;
  double wanted = 0.0, given = 0.0;
  for (const Face& face : mesh.face) {
    faces.push_back(flat_face(mesh, face, moduli));
    wanted += faces.back().wanted(0);
  }
  MembraneFit fit = fit_of(mesh, springs, faces);
  fit.settle();
  Eigen::VectorXd stiffness(static_cast<Eigen::Index>(springs.size()));
  for (std::size_t s = 0; s < springs.size(); ++s) {
    for (const auto& share : fit.springs[s].shares) given += fit.springs[s].tension * share.moments(0);
    stiffness(static_cast<Eigen::Index>(s)) = fit.springs[s].tension / way(mesh, springs[s]).squaredNorm();
  }
  return stiffness * (wanted / given);
}

}  // namespace billow::sim
