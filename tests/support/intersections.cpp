// Signs of determinants: in floating point where that is certain, or else as sums of doubles without rounding.
#include "tests/support/intersections.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace billow::test {
namespace {

using Point = Eigen::Vector3d;

// Every double here is a multiple of 2^-352 below 2^301, so three multiplied are one of 2^-1056 below 2^903: nothing
// overflows, and no rounding error is too small for a double.
constexpr double least_coordinate = 0x1p-300, greatest_coordinate = 0x1p300;

// Half the distance from 1 to the next double. The bounds are those of Shewchuk, Adaptive Precision Floating-Point
// Arithmetic and Fast Robust Geometric Predicates (1997): of the error, relative to the sum of the terms' magnitudes.
constexpr double epsilon = 0x1p-53;
constexpr double plane_bound = (3.0 + 16.0 * epsilon) * epsilon;
constexpr double space_bound = (7.0 + 56.0 * epsilon) * epsilon;

int sign(double value) { return (value > 0.0) - (value < 0.0); }

// What floating point makes of an operation, and what it leaves out: value + error is exact.
struct Exact {
  double value, error;
};

Exact exact_sum(double a, double b) {
  const double sum = a + b;
  const double b_added = sum - a, a_added = sum - b_added;
  return {sum, (a - a_added) + (b - b_added)};
}

Exact exact_difference(double a, double b) { return exact_sum(a, -b); }

Exact exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

// A sum without rounding: doubles whose bits do not overlap, none of them 0, smallest first. The last thus outweighs
// all others together.
class ExactSum {
 public:
  void add(double term) {
    int kept = 0;
    for (int k = 0; k < size_; ++k) {
      const Exact sum = exact_sum(term, part_[k]);
      if (sum.error != 0.0) part_[kept++] = sum.error;
      term = sum.value;
    }
    if (term != 0.0) part_[kept++] = term;
    size_ = kept;
  }

  void add_product(double a, double b, double c) {
    const Exact ab = exact_product(a, b);
    for (const double factor : {ab.value, ab.error}) {
      if (factor == 0.0) continue;
      const Exact abc = exact_product(factor, c);
      add(abc.error);
      add(abc.value);
    }
  }

  void add_product(const Exact& a, const Exact& b, const Exact& c) {
    for (const double x : {a.error, a.value})
      for (const double y : {b.error, b.value})
        for (const double z : {c.error, c.value})
          if (x != 0.0 && y != 0.0 && z != 0.0) add_product(x, y, z);
  }

  int sign() const { return size_ == 0 ? 0 : test::sign(part_[size_ - 1]); }

 private:
  std::array<double, 192> part_;  // six products of three values of two parts each make no more than 6 * 8 * 4
  int size_ = 0;
};

Exact negative(const Exact& a) { return {-a.value, -a.error}; }

int exact_plane_orientation(const Point& a, const Point& b, const Point& c, int x, int y) {
  const Exact one{1.0, 0.0};
  ExactSum sum;
  sum.add_product(exact_difference(a[x], c[x]), exact_difference(b[y], c[y]), one);
  sum.add_product(exact_difference(c[y], a[y]), exact_difference(b[x], c[x]), one);
  return sum.sign();
}

// Of the axes x and y alone: 1 where a, b, c turn from x to y, -1 where they turn back, 0 on one line.
int plane_orientation(const Point& a, const Point& b, const Point& c, int x, int y) {
  const double forward = (a[x] - c[x]) * (b[y] - c[y]), back = (a[y] - c[y]) * (b[x] - c[x]);
  const double magnitude = std::abs(forward) + std::abs(back);
  if (magnitude == 0.0) return 0;
  const double turn = forward - back;
  return std::abs(turn) > plane_bound * magnitude ? sign(turn) : exact_plane_orientation(a, b, c, x, y);
}

int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  std::array<Exact, 3> u, v, w;
  for (int axis = 0; axis < 3; ++axis) {
    u[axis] = exact_difference(a[axis], d[axis]);
    v[axis] = exact_difference(b[axis], d[axis]);
    w[axis] = exact_difference(c[axis], d[axis]);
  }
  ExactSum sum;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    sum.add_product(u[axis], v[next], w[last]);
    sum.add_product(negative(u[axis]), v[last], w[next]);
  }
  return sum.sign();
}

// 1 where d is below the plane of a, b, c, which turn counter-clockwise seen from above; -1 above; 0 in one plane.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = a - d, v = b - d, w = c - d;
  double volume = 0.0, magnitude = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const double forward = v[next] * w[last], back = v[last] * w[next];
    volume += u[axis] * (forward - back);
    magnitude += std::abs(u[axis]) * (std::abs(forward) + std::abs(back));
  }
  if (magnitude == 0.0) return 0;
  return std::abs(volume) > space_bound * magnitude ? sign(volume) : exact_orientation(a, b, c, d);
}

using Segment = std::array<Point, 2>;
using Triangle = std::array<Point, 3>;

// Whether a line in the plane of the axes x and y has the two strictly on different sides. What does not meet there is
// parted by a line along the segment or along a side of the triangle, unless all is on one line.
bool parted_in_plane(const Segment& s, const Triangle& t, int x, int y) {
  std::array<int, 3> corner;
  for (int c = 0; c < 3; ++c) corner[c] = plane_orientation(s[0], s[1], t[c], x, y);
  if (corner[0] != 0 && corner[0] == corner[1] && corner[0] == corner[2]) return true;
  const int inside = plane_orientation(t[0], t[1], t[2], x, y);
  for (int c = 0; c < 3; ++c) {
    const Point &from = t[c], &to = t[(c + 1) % 3];
    const int end = plane_orientation(from, to, s[0], x, y);
    if (end != 0 && end != inside && end == plane_orientation(from, to, s[1], x, y)) return true;
  }
  return false;
}

// Whether a segment and a triangle whose boxes meet have a point in common. Their images along the three axes then
// meet, and where all is in one plane that is enough: one of the images is that plane's, undistorted but for a linear
// map, and on one line it is the boxes that tell. Where the segment crosses the plane it does so in one point, which is
// in the triangle if all sides pass the segment in the same sense. The sides of a triangle without area never do,
// unless all is in one plane.
bool meet(const Segment& s, const Triangle& t) {
  for (int axis = 0; axis < 3; ++axis)
    if (parted_in_plane(s, t, (axis + 1) % 3, (axis + 2) % 3)) return false;
  const int begin = orientation(t[0], t[1], t[2], s[0]);
  if (begin != 0 && begin == orientation(t[0], t[1], t[2], s[1])) return false;
  bool forward = false, back = false;
  for (int c = 0; c < 3; ++c) {
    const int side = orientation(s[0], s[1], t[c], t[(c + 1) % 3]);
    forward |= side > 0;
    back |= side < 0;
  }
  return !(forward && back);
}

// An edge or a triangle, by its place in the list of its kind.
struct Boxed {
  Eigen::AlignedBox3d box;
  int place;
  bool is_edge;
};

using Edge = std::array<int, 2>;

std::vector<Edge> edges_of(const Eigen::MatrixX3i& triangle) {
  std::vector<Edge> edges;
  for (Eigen::Index t = 0; t < triangle.rows(); ++t)
    for (int c = 0; c < 3; ++c) {
      const int a = triangle(t, c), b = triangle(t, (c + 1) % 3);
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

class Sweep {
 public:
  explicit Sweep(const TriangleSoup& soup) : soup_(soup), edge_(edges_of(soup.triangle)) {
    for (std::size_t e = 0; e < edge_.size(); ++e) add_box(segment(e), e, true);
    for (Eigen::Index t = 0; t < soup.triangle.rows(); ++t) add_box(triangle(t), t, false);
  }

  // Sweeps a plane through all boxes: whatever it enters is tried with those of the other kind that it is still in.
  std::vector<Crossing> crossings() {
    const int axis = longest_axis();
    std::sort(boxed_.begin(), boxed_.end(),
              [axis](const Boxed& a, const Boxed& b) { return a.box.min()[axis] < b.box.min()[axis]; });
    std::array<std::vector<Boxed>, 2> entered;
    for (const Boxed& b : boxed_) {
      std::vector<Boxed>& others = entered[!b.is_edge];
      std::erase_if(others, [&](const Boxed& other) { return other.box.max()[axis] < b.box.min()[axis]; });
      for (const Boxed& other : others)
        if (b.box.intersects(other.box)) b.is_edge ? try_pair(b.place, other.place) : try_pair(other.place, b.place);
      entered[b.is_edge].push_back(b);
    }
    std::sort(found_.begin(), found_.end());
    return std::move(found_);
  }

 private:
  Point point(int vertex) const { return soup_.position.row(vertex); }
  Segment segment(int e) const { return {point(edge_[e][0]), point(edge_[e][1])}; }
  Triangle triangle(int t) const {
    return {point(soup_.triangle(t, 0)), point(soup_.triangle(t, 1)), point(soup_.triangle(t, 2))};
  }

  template <class Corners>
  void add_box(const Corners& corners, int place, bool is_edge) {
    Eigen::AlignedBox3d box;
    for (const Point& corner : corners) box.extend(corner);
    boxed_.push_back({box, place, is_edge});
  }

  int longest_axis() const {
    Eigen::AlignedBox3d all;
    for (const Boxed& b : boxed_) all.extend(b.box);
    int axis = 0;
    if (!boxed_.empty()) all.sizes().maxCoeff(&axis);
    return axis;
  }

  bool share_a_vertex(int e, int t) const {
    const auto corner = soup_.triangle.row(t);
    return (corner.array() == edge_[e][0]).any() || (corner.array() == edge_[e][1]).any();
  }

  void try_pair(int e, int t) {
    if (!share_a_vertex(e, t) && meet(segment(e), triangle(t))) found_.push_back({edge_[e][0], edge_[e][1], t});
  }

  const TriangleSoup& soup_;
  std::vector<Edge> edge_;
  std::vector<Boxed> boxed_;
  std::vector<Crossing> found_;
};

void check_coordinates(const TriangleSoup& soup) {
  for (const int vertex : soup.triangle.reshaped())
    for (const double x : soup.position.row(vertex))
      if (!(x == 0.0 || (std::abs(x) >= least_coordinate && std::abs(x) <= greatest_coordinate)))
        throw std::invalid_argument("a coordinate is not finite, or too small or large to decide exactly");
}

}  // namespace

void TriangleSoup::add(const Eigen::MatrixX3d& p, const std::vector<sim::Face>& faces) {
  const int first = static_cast<int>(position.rows());
  position.conservativeResize(first + p.rows(), 3);
  position.bottomRows(p.rows()) = p;
  std::vector<Eigen::RowVector3i> added;
  for (const sim::Face& f : faces)
    for (int c = 2; c < sim::corner_count(f); ++c) added.emplace_back(first + f[0], first + f[c - 1], first + f[c]);
  const Eigen::Index triangles = triangle.rows();
  triangle.conservativeResize(triangles + static_cast<Eigen::Index>(added.size()), 3);
  for (std::size_t t = 0; t < added.size(); ++t) triangle.row(triangles + static_cast<Eigen::Index>(t)) = added[t];
}

std::vector<Crossing> crossings(const TriangleSoup& soup) {
  check_coordinates(soup);
  return Sweep(soup).crossings();
}

}  // namespace billow::test
