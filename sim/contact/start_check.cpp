// Edges against triangles.
#include "sim/contact/start_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "sim/contact/box_tree.h"
#include "sim/contact/closest_points.h"

namespace billow::sim {

namespace {

// Six times the volume of the tetrahedron abcd, positive where d lies on the side of abc from which it runs clockwise.
double volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

// Whether the edge pq goes through the triangle: where it goes through the plane it must be in the triangle, to
// rounding. Signs alone would call neighbours in one plane crossing.
bool goes_through(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& a,
                  const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double over = volume(a, b, c, p), under = volume(a, b, c, q);
  if (over == under || (over > 0.0) == (under > 0.0)) return false;
  const Eigen::Vector3d point = p + over / (over - under) * (q - p);
  const Eigen::Vector3d weight = nearest_in_triangle(point, a, b, c);
  constexpr double rounding = 1e-9;
  return (weight(0) * a + weight(1) * b + weight(2) * c - point).norm() <= rounding * (q - p).norm();
}

/// Two parts and what of them crosses.
class PairCheck {
 public:
  PairCheck(const ContactSurface& surface, const Points& x, const SurfacePart& a, const SurfacePart& b)
      : surface_(surface), x_(x), a_(a), b_(b) {}

  void look(const FacePair& pair) {
    if (crosses(pair.first, pair.second) || crosses(pair.second, pair.first))
      crossing_.emplace(surface_.polygon[pair.first], surface_.polygon[pair.second]);
  }

  void report() const {
    if (crossing_.empty()) return;
    const auto& [first, second] = *crossing_.begin();
    if (&a_ == &b_)
      throw StartError(
          fmt::format("'{0}' crosses itself where the run starts, in {1} {2} of faces, the first of them {3} and {4}; "
                      "unfold it, or say 'contact: {{self: false}}'",
                      a_.name, crossing_.size(), crossing_.size() == 1 ? "pair" : "pairs", first, second),
          a_.body);
    throw StartError(
        fmt::format("'{0}' and '{1}' cross where the run starts, in {2} {3} of faces, the first of them face {4} of "
                    "'{0}' and face {5} of '{1}'; move them apart, or say 'contact: none'",
                    a_.name, b_.name, crossing_.size(), crossing_.size() == 1 ? "pair" : "pairs", first, second),
        a_.body);
  }

 private:
  bool crosses(int edges_of, int triangle) const {
    const std::array<int, 3>&face = surface_.face[edges_of], &other = surface_.face[triangle];
    for (int k = 0; k < 3; ++k) {
      const int p = face[k], q = face[(k + 1) % 3];
      const auto shared = [&](int v) { return std::find(other.begin(), other.end(), v) != other.end(); };
      if (shared(p) || shared(q)) continue;
      if (goes_through(x_[p], x_[q], x_[other[0]], x_[other[1]], x_[other[2]])) return true;
    }
    return false;
  }

  const ContactSurface& surface_;
  const Points& x_;
  const SurfacePart &a_, &b_;
  std::set<std::pair<int, int>> crossing_;  // polygons
};

// A body's faces reach into something rounded where they come nearer to its segment than its radius.
void check_out_of(const SurfacePart& body, const SurfacePart& rounded, const ContactSurface& surface, const Points& x) {
  const Eigen::Vector3d &from = x[rounded.first_vertex], &to = x[rounded.first_vertex + rounded.vertices - 1];
  for (int f = body.first_face; f < body.first_face + body.faces; ++f) {
    const std::array<int, 3>& face = surface.face[f];
    double least = INFINITY;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d &p = x[face[k]], &q = x[face[(k + 1) % 3]];
      const Eigen::Vector2d at = nearest_on_segments(from, to, p, q);
      least = std::min(least, (from + at(0) * (to - from) - p - at(1) * (q - p)).norm());
    }
    for (const Eigen::Vector3d& end : {from, to}) {
      const Eigen::Vector3d w = nearest_in_triangle(end, x[face[0]], x[face[1]], x[face[2]]);
      least = std::min(least, (w(0) * x[face[0]] + w(1) * x[face[1]] + w(2) * x[face[2]] - end).norm());
    }
    if (least < rounded.radius)
      throw StartError(fmt::format("face {} of '{}' reaches {:.3g} m into '{}' where the run starts; move them apart, "
                                   "or say 'contact: none'",
                                   surface.polygon[f], body.name, rounded.radius - least, rounded.name),
                       body.body);
  }
}

}  // namespace

void check_apart(const ContactSurface& surface, const Points& x) {
  std::vector<BoxTree> tree;
  const std::vector<double> touching(x.size(), 1e-12);  // [m] boxes that touch count as near
  for (const SurfacePart& part : surface.part) tree.emplace_back(surface, part).refit(x, x, touching);
  for (std::size_t a = 0; a < tree.size(); ++a)
    for (std::size_t b = a; b < tree.size(); ++b) {
      const SurfacePart &first = surface.part[a], &second = surface.part[b];
      if (a == b ? !first.self : !first.is_body()) continue;
      if (second.rounded()) {
        check_out_of(first, second, surface, x);
        continue;
      }
      PairCheck check(surface, x, first, second);
      std::vector<BoxTree::Task> tasks;
      BoxTree::split(tree[a], tree[b], tasks);
      for (const BoxTree::Task& task : tasks) {
        std::vector<FacePair> pairs;
        BoxTree::pairs(task, pairs);
        for (const FacePair& pair : pairs) check.look(pair);
      }
      check.report();
    }
}

}  // namespace billow::sim
