// Four points p of a plane hang together by weights c with sum c = 0 and sum c p = 0. Springs between all of them whose
// tensions per length are -s c_i c_j are in balance, and where the points leave the plane by w, those tensions have
// the energy 1/2 sum -s c_i c_j (w_i - w_j)^2 = 1/2 s (sum c w)^2, s >= 0: that of a hinge, in the bending angle's
// square, made of linear springs. With w = 1/2 x . kappa x it is 1/2 s (Q : kappa)^2, Q = 1/2 sum c p p^T; and the
// hinges around every vertex are so strong that the sum of their s Q Q is the plate's.
#include "sim/body/bending_springs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "sim/body/moment_fit.h"
#include "sim/mesh/face_vector.h"

namespace billow::sim {
namespace {

using Fit = MomentFit<6>;
using Pair = std::pair<int, int>;

constexpr double poisson = 1.0 / 3.0;

// Four points nearer to one line than this, in shares of their distances, make no hinge.
constexpr double flattest = 1e-6;

// Q Q as a symmetric form on (xx, yy, root 2 xy).
Fit::Moments product(const Eigen::Matrix2d& q) {
  const double root = std::numbers::sqrt2, x = q(0, 0), y = q(1, 1), z = root * q(0, 1);
  Fit::Moments moments;
  moments << x * x, y * y, z * z, root * x * y, root * x * z, root * y * z;
  return moments;
}

// B ((tr kappa)^2 - 2 (1 - nu) det kappa) in the same terms.
Fit::Moments plate(double rigidity) {
  Fit::Moments moments;
  moments << 1.0, 1.0, 1.0 - poisson, std::numbers::sqrt2 * poisson, 0.0, 0.0;
  return rigidity * moments;
}

struct Hinge {
  std::array<int, 4> point;
  Eigen::Vector4d weight;    // c [1]
  Eigen::Matrix2d shape;     // Q [m^2]
  std::vector<int> centres;  // the vertices that it bends around
};

class Sheet {
 public:
  Sheet(const Mesh& mesh, const std::vector<SpringPair>& springs) : mesh_(mesh), springs_(springs) {
    joined_.resize(mesh.vertices());
    area_ = Eigen::VectorXd::Zero(mesh.vertices());
    normal_ = Eigen::MatrixX3d::Zero(mesh.vertices(), 3);
    for (int s = 0; s < static_cast<int>(springs.size()); ++s) {
      number_[{springs[s].first, springs[s].second}] = s;
      joined_[springs[s].first].push_back(springs[s].second);
      joined_[springs[s].second].push_back(springs[s].first);
    }
    for (std::vector<int>& others : joined_) std::sort(others.begin(), others.end());
    for (const Face& face : mesh.face) add_area(face);
  }

  double area(int vertex) const { return area_(vertex); }
  int number(int a, int b) const { return number_.at(std::minmax(a, b)); }

  /// Around the middle of every bend spring, with each vertex that is joined to all three; and over every edge between
  /// two triangles.
  std::vector<Hinge> hinges() const {
    std::vector<Hinge> hinges;
    for (const auto& [kind, a, b] : springs_) {
      if (kind == SpringKind::bend) {
        const int middle = middle_of(a, b);
        for (const int w : joined_to_both(a, b))
          if (w != middle && are_joined(w, middle)) add({a, b, middle, w}, {middle}, hinges);
      } else if (kind == SpringKind::structural) {
        const std::vector<int> far = corners_over(a, b);
        if (far.size() == 2 && are_joined(far[0], far[1])) add({far[0], far[1], a, b}, {a, b}, hinges);
      }
    }
    return hinges;
  }

 private:
  Eigen::Vector3d place(int v) const { return mesh_.position.row(v); }
  bool are_joined(int a, int b) const { return number_.contains(std::minmax(a, b)); }
  bool is(SpringKind kind, int a, int b) const { return springs_[number(a, b)].kind == kind; }

  void add_area(const Face& face) {
    const int corners = corner_count(face);
    const Eigen::RowVector3d vector = area_vector(mesh_.position, face);
    for (int c = 0; c < corners; ++c) {
      area_(face[c]) += vector.norm() / corners;
      normal_.row(face[c]) += vector;
    }
  }

  std::vector<int> joined_to_both(int a, int b) const {
    std::vector<int> both;
    std::set_intersection(joined_[a].begin(), joined_[a].end(), joined_[b].begin(), joined_[b].end(),
                          std::back_inserter(both));
    return both;
  }

  // The vertex that a bend spring goes straight across: the shortest detour by springs that are no bend springs.
  int middle_of(int a, int b) const {
    int middle = -1;
    double shortest = INFINITY;
    for (const int v : joined_to_both(a, b)) {
      if (is(SpringKind::bend, a, v) || is(SpringKind::bend, b, v)) continue;
      const double detour = (place(v) - place(a)).norm() + (place(v) - place(b)).norm();
      if (detour < shortest) shortest = detour, middle = v;
    }
    return middle;
  }

  // The third corners of the triangles that edges make with this one.
  std::vector<int> corners_over(int a, int b) const {
    std::vector<int> far;
    for (const int w : joined_to_both(a, b))
      if (is(SpringKind::structural, a, w) && is(SpringKind::structural, b, w)) far.push_back(w);
    return far;
  }

  // A plane at the first centre; weights are the signed areas of the triangles that the other three points make.
  void add(const std::array<int, 4>& point, const std::vector<int>& centres, std::vector<Hinge>& hinges) const {
    if (centres[0] < 0) return;
    const Eigen::Vector3d normal = normal_.row(centres[0]).transpose().normalized();
    const Eigen::Vector3d first = normal.unitOrthogonal(), second = normal.cross(first);
    Eigen::Matrix<double, 2, 4> p;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d from = place(point[i]) - place(centres[0]);
      p.col(i) << first.dot(from), second.dot(from);
    }
    Hinge hinge{point, {}, Eigen::Matrix2d::Zero(), centres};
    for (int i = 0; i < 4; ++i) {
      const auto o = p.col((i + 1) % 4), a = p.col((i + 2) % 4), b = p.col((i + 3) % 4);
      const Eigen::Vector2d oa = a - o, ob = b - o;
      hinge.weight(i) = (i % 2 ? -1.0 : 1.0) * (oa(0) * ob(1) - oa(1) * ob(0));
    }
    const double size = hinge.weight.norm();
    if (!(size > flattest * p.squaredNorm())) return;
    hinge.weight /= size;
    for (int i = 0; i < 4; ++i) hinge.shape += 0.5 * hinge.weight(i) * p.col(i) * p.col(i).transpose();
    hinges.push_back(std::move(hinge));
  }

  const Mesh& mesh_;
  const std::vector<SpringPair>& springs_;
  std::map<Pair, int> number_;
  std::vector<std::vector<int>> joined_;
  Eigen::VectorXd area_;
  Eigen::MatrixX3d normal_;
};

// Every vertex is a cell, and wants the plate's energy over its area. Usually its hinges share it alike: a trace of
// 8/3 B A among as many as there are.
Fit fit_of(const Sheet& sheet, const std::vector<Hinge>& hinges, int vertices, double rigidity) {
  Fit fit;
  fit.cells.resize(vertices);
  std::vector<double> count(vertices, 0.0);
  for (const Hinge& hinge : hinges)
    for (const int v : hinge.centres) count[v] += 1.0 / static_cast<double>(hinge.centres.size());
  for (int v = 0; v < vertices; ++v) fit.cells[v] = {sheet.area(v) * plate(rigidity), sheet.area(v)};
  const double trace = plate(rigidity).head<3>().sum();
  fit.springs.resize(hinges.size());
  for (int h = 0; h < static_cast<int>(hinges.size()); ++h) {
    const Fit::Moments moments = product(hinges[h].shape);
    const double share = 1.0 / static_cast<double>(hinges[h].centres.size());
    for (const int v : hinges[h].centres) {
      fit.give(h, {v, share * moments});
      fit.springs[h].usual += share * trace * sheet.area(v) / count[v] / moments.head<3>().sum();
    }
  }
  return fit;
}

}  // namespace

Eigen::VectorXd bending_force_density(const Mesh& mesh, const std::vector<SpringPair>& springs, double rigidity) {
  const Sheet sheet(mesh, springs);
  const std::vector<Hinge> hinges = sheet.hinges();
  Fit fit = fit_of(sheet, hinges, mesh.vertices(), rigidity);
  fit.settle();
  Eigen::VectorXd density = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(springs.size()));
  for (std::size_t h = 0; h < hinges.size(); ++h)
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        density(sheet.number(hinges[h].point[i], hinges[h].point[j])) -=
            fit.springs[h].tension * hinges[h].weight(i) * hinges[h].weight(j);
  return density;
}

}  // namespace billow::sim
