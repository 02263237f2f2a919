// The checker of intersections, checked: against integers, a last place off, and on sheets whose crossings are known.
#include "tests/support/intersections.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "base/random.h"
#include "tests/support/mesh_files.h"

namespace billow::test {
namespace {

using Lattice = Eigen::Matrix<std::int64_t, Eigen::Dynamic, 3>;
using LatticePoint = Eigen::Matrix<std::int64_t, 3, 1>;

// The t of a line that it has in common with half-spaces: from low to high, fractions of integers with denominators
// above 0. Coordinates below 2^10 make both less than 2^48.
class LineInterval {
 public:
  using Integer = __int128;

  // Keeps what has value + slope t >= 0.
  void clip(Integer value, Integer slope) {
    if (slope == 0) empty_ |= value < 0;
    if (slope > 0 && -value * low_[1] > low_[0] * slope) low_ = {-value, slope};
    if (slope < 0 && value * high_[1] < high_[0] * -slope) high_ = {value, -slope};
  }

  bool empty() const { return empty_ || low_[0] * high_[1] > high_[0] * low_[1]; }

 private:
  std::array<Integer, 2> low_{0, 1}, high_{1, 1};
  bool empty_ = false;
};

// Rows 0 and 1 of `p` are a segment, rows 2, 3, 4 a triangle with an area: the segment clipped by its plane and sides.
bool meet_on_lattice(const Lattice& p) {
  const LatticePoint begin = p.row(0), along = p.row(1) - p.row(0);
  const LatticePoint normal = LatticePoint(p.row(3) - p.row(2)).cross(LatticePoint(p.row(4) - p.row(2)));
  LineInterval interval;
  const auto clip = [&](const LatticePoint& inward, const LatticePoint& at) {
    interval.clip(inward.dot(begin - at), inward.dot(along));
  };
  clip(normal, p.row(2));
  clip(-normal, p.row(2));
  for (int c = 0; c < 3; ++c) {
    const LatticePoint from = p.row(2 + c), to = p.row(2 + (c + 1) % 3);
    clip(normal.cross(to - from), from);
  }
  return !interval.empty();
}

// Of the triangle in the last three rows.
bool has_area(const Lattice& p) {
  const Lattice t = p.bottomRows(3);
  return !LatticePoint(t.row(1) - t.row(0)).cross(LatticePoint(t.row(2) - t.row(0))).isZero();
}

Lattice random_lattice(int points, int reach, std::mt19937_64& bits) {
  Lattice p(points, 3);
  for (int i = 0; i < points; ++i)
    for (int axis = 0; axis < 3; ++axis) p(i, axis) = static_cast<int>(bits() % (2 * reach + 1)) - reach;
  return p;
}

// Rows 0 and 1 of `p` are a segment, rows 2, 3, 4 a triangle.
bool meet(const Eigen::MatrixX3d& p) {
  TriangleSoup soup;
  soup.add(p, {{0, 1, 1, -1}, {2, 3, 4, -1}});
  const std::vector<Crossing> found = crossings(soup);
  return std::count(found.begin(), found.end(), Crossing{0, 1, 1}) == 1;
}

bool meet(const Eigen::Vector3d& begin, const Eigen::Vector3d& end, const Eigen::Matrix3d& corners) {
  Eigen::MatrixX3d p(5, 3);
  p << begin.transpose(), end.transpose(), corners;
  return meet(p);
}

// Corners in rows. Its plane is z = 0.
Eigen::Matrix3d right_triangle() { return (Eigen::Matrix3d() << 0, 0, 0, 4, 0, 0, 0, 4, 0).finished(); }

// Of few places nearly all touch somewhere, of many hardly any.
TEST(Intersections, AreThoseOfIntegers) {
  for (const int reach : {1, 2, 3, 1000}) {
    SCOPED_TRACE(reach);
    std::mt19937_64 bits(reach);
    int meeting = 0;
    for (int k = 0; k < 3000; ++k) {
      const Lattice p = random_lattice(5, reach, bits);
      if (!has_area(p)) continue;
      const bool expected = meet_on_lattice(p);
      ASSERT_EQ(meet(p.cast<double>()), expected) << p;
      meeting += expected;
    }
    EXPECT_GT(meeting, 100);
  }
}

// A lattice sheared and moved meets where it met, though almost no product of its coordinates fits a double.
TEST(Intersections, AreKeptByAffineMaps) {
  const Eigen::Matrix3d shear = (Eigen::Matrix3d() << 1, 0, 0, 0x1p30 + 1, 1, 0, 0x1p47 - 5, 0x1p31 + 7, 1).finished();
  const Eigen::RowVector3d far(0x1p51 + 3, 0x1p50 - 1, -0x1p49 - 9);
  std::mt19937_64 bits(11);
  int meeting = 0;
  for (int k = 0; k < 3000; ++k) {
    const Lattice p = random_lattice(5, 3, bits);
    if (!has_area(p)) continue;
    const bool expected = meet_on_lattice(p);
    const Eigen::MatrixX3d sheared = p.cast<double>() * shear;
    ASSERT_EQ(meet(sheared), expected) << p;
    ASSERT_EQ(meet(sheared.rowwise() + far), expected) << p;
    ASSERT_EQ(meet(sheared * Eigen::DiagonalMatrix<double, 3>(0x1p-200, 0x1p-20, 0x1p90)), expected) << p;
    meeting += expected;
  }
  EXPECT_GT(meeting, 300);
}

// Many small triangles, and one that is as large as all of space.
TriangleSoup lattice_soup(int triangles, int reach, std::mt19937_64& bits) {
  TriangleSoup soup;
  Lattice large(3, 3);
  large << -reach, -reach, 1, reach, -reach, 0, 0, 3 * reach, -1;
  soup.add(large.cast<double>(), {{0, 1, 2, -1}});
  while (soup.triangle.rows() < triangles) {
    Lattice small = random_lattice(3, 3, bits);
    if (!has_area(small)) continue;
    small.rowwise() += random_lattice(1, reach, bits).row(0);
    soup.add(small.cast<double>(), {{0, 1, 2, -1}});
  }
  return soup;
}

TEST(Intersections, OfASoupAreThoseOfAllItsPairs) {
  std::mt19937_64 bits(5);
  for (const int reach : {4, 12}) {
    SCOPED_TRACE(reach);
    const TriangleSoup soup = lattice_soup(60, reach, bits);
    const Lattice p = soup.position.cast<std::int64_t>();
    std::vector<Crossing> expected;
    for (int v = 0; v < p.rows(); ++v)
      for (int t = 0; t < soup.triangle.rows(); ++t) {
        const int next = v % 3 == 2 ? v - 2 : v + 1;
        Lattice pair(5, 3);
        pair << p.row(v), p.row(next), p.middleRows(3 * t, 3);
        if (t != v / 3 && meet_on_lattice(pair)) expected.push_back({std::min(v, next), std::max(v, next), t});
      }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(crossings(soup), expected);
    EXPECT_GT(expected.size(), 20u);
  }
}

// What is a few of the coordinates' last places off the plane z = 3 x + slope y, whose side doubles often get wrong.
void expect_true_sides_of_plane(double slope) {
  Eigen::Matrix3d corners;
  corners << -24.3, -24.7, 0, 24.1, -23.9, 0, 12.6, 24.2, 0;
  corners.col(0) = (corners.col(0) * 0x1p10).array().round() / 0x1p10;
  corners.col(1) = (corners.col(1) * 0x1p40).array().round() / 0x1p40;
  corners.col(2) = 3.0 * corners.col(0) + slope * corners.col(1);
  for (int i = -20; i < 20; ++i)
    for (int j = -20; j < 20; ++j) {
      const Eigen::Vector3d end(0.5 + i * 0x1p-53, 0.125, 1.5 + slope * 0.125 + j * 0x1p-52);
      EXPECT_EQ(meet({0.3, 0.2, 2.7}, end, corners), 2 * j <= 3 * i) << i << " " << j;
      EXPECT_EQ(meet({1.7, 0.2, 0.3}, end, corners), 2 * j >= 3 * i) << i << " " << j;
    }
}

TEST(Intersections, AreTrueToTheLastPlace) {
  expect_true_sides_of_plane(0.0);
  expect_true_sides_of_plane(2.0);
}

// Likewise off the side y = 3 x of a triangle in whose plane everything is.
TEST(Intersections, AreTrueToTheLastPlaceInThePlane) {
  Eigen::Matrix3d corners;
  corners << 0, 0, 1.7, 0, 0, 1.7, 24, -24, 1.7;
  corners.col(0).head<2>() << -24881.0 / 1024.0, 24679.0 / 1024.0;
  corners.col(1).head<2>() = 3.0 * corners.col(0).head<2>();
  for (int i = -20; i < 20; ++i)
    for (int j = -20; j < 20; ++j) {
      const Eigen::Vector3d end(0.5 + i * 0x1p-53, 1.5 + j * 0x1p-52, 1.7);
      EXPECT_EQ(meet({0.3, 2.7, 1.7}, end, corners), 2 * j <= 3 * i) << i << " " << j;
    }
}

// Differences of such coordinates take more than a double.
TEST(Intersections, AreTrueToTheLastPlaceBesideCornersFarAway) {
  Eigen::Matrix3d corners;
  corners << -0x1p60, -0x1p59, -0x1p60, 0x1p61, 0, 0x1p61, 0.1, 0x1p60, 0.1;
  const Eigen::Vector3d above(0.3, 0.0, 0.5);
  for (const double x : {1.0, 0.1, 1e-9}) {
    EXPECT_TRUE(meet(above, {x, 1.0, x}, corners));
    EXPECT_TRUE(meet(above, {x, 1.0, std::nextafter(x, 0.0)}, corners));
    EXPECT_FALSE(meet(above, {x, 1.0, std::nextafter(x, 2.0)}, corners));
  }
}

TEST(Intersections, IncludeTouchingAtCornersAndSides) {
  const Eigen::Matrix3d corners = right_triangle();
  const double above = std::nextafter(0.0, 1.0) * 0x1p900, beside = std::nextafter(2.0, 3.0);
  EXPECT_TRUE(meet({0, 0, -1}, {0, 0, 1}, corners)) << "through a corner";
  EXPECT_TRUE(meet({4, 0, 0}, {5, 5, 5}, corners)) << "from a corner";
  EXPECT_TRUE(meet({2, 2, -1}, {2, 2, 1}, corners)) << "through a side";
  EXPECT_FALSE(meet({beside, 2, -1}, {beside, 2, 1}, corners)) << "past a side";
  EXPECT_TRUE(meet({1, 1, 0}, {1, 1, 1}, corners)) << "from within";
  EXPECT_FALSE(meet({1, 1, above}, {1, 1, 1}, corners)) << "from above";
  EXPECT_TRUE(meet({1, 1, -1}, {1, 1, 1}, corners)) << "through the middle";
}

TEST(Intersections, IncludeTouchingInThePlane) {
  const Eigen::Matrix3d corners = right_triangle();
  EXPECT_TRUE(meet({1, 1, 0}, {1.5, 1, 0}, corners)) << "within";
  EXPECT_TRUE(meet({-1, 1, 0}, {5, 1, 0}, corners)) << "right through";
  EXPECT_TRUE(meet({-1, 0, 0}, {0, 0, 0}, corners)) << "along a side's line, up to its end";
  EXPECT_FALSE(meet({-1, 0, 0}, {-0x1p-80, 0, 0}, corners)) << "along a side's line, before its end";
  EXPECT_TRUE(meet({4, -1, 0}, {4, 1, 0}, corners)) << "past a corner, touching it";
  EXPECT_TRUE(meet({3, 3, 0}, {2, 2, 0}, corners)) << "up to a side";
  EXPECT_FALSE(meet({3, 3, 0}, {2, std::nextafter(2.0, 3.0), 0}, corners)) << "not quite up to a side";
  EXPECT_FALSE(meet({5, 1, 0}, {1, 5, 0}, corners)) << "boxes meet, nothing else";
}

TEST(Intersections, IncludeTrianglesWithoutArea) {
  Eigen::Matrix3d line, point;
  line << 0, 0, 0, 3, 6, 9, 1, 2, 3;
  point << 1, 2, 3, 1, 2, 3, 1, 2, 3;
  for (const Eigen::Matrix3d& corners : {line, point}) {
    EXPECT_TRUE(meet({0, 2, 3}, {2, 2, 3}, corners)) << "across";
    EXPECT_TRUE(meet({0.5, 1, 1.5}, {1, 2, 3}, corners)) << "along";
    EXPECT_FALSE(meet({-1, -2, -3}, {-0.5, -1, -1.5}, corners)) << "on the line, before its beginning";
    EXPECT_FALSE(meet({0, 2, 3.125}, {2, 2, 3.125}, corners)) << "askew";
    EXPECT_FALSE(meet({0.5, 2, 3}, {0.75, 2, 3}, corners)) << "in one plane, apart";
  }
}

// On one line only boxes tell what is apart, and not along the axis that the rest is longest in.
TEST(Intersections, OnALineAreWhereBoxesMeet) {
  Eigen::MatrixX3d p(7, 3);
  p << 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, -50, 9, 9, 50, 9, 9;
  for (const double gap : {0.0, 0x1p-40}) {
    p(2, 1) = 1.0 + gap;
    TriangleSoup soup;
    soup.add(p, {{0, 1, 1, -1}, {2, 3, 4, -1}, {5, 6, 6, -1}});
    EXPECT_EQ(crossings(soup).empty(), gap > 0.0);
  }
}

TEST(Intersections, AreTheSameFarFromTheOrigin) {
  const Eigen::RowVector3d far(0x1p50, -0x1p49, 0x1p48);
  const Eigen::Matrix3d corners = right_triangle().rowwise() + far;
  const auto meets = [&](const Eigen::RowVector3d& begin, const Eigen::RowVector3d& end) {
    return meet((begin + far).transpose(), (end + far).transpose(), corners);
  };
  EXPECT_TRUE(meets({1, 1, 0}, {1, 1, 1}));
  EXPECT_FALSE(meets({1, 1, 0.0625}, {1, 1, 1}));
  EXPECT_TRUE(meets({2, 2, -1}, {2, 2, 1}));
  EXPECT_FALSE(meets({2.25, 2, -1}, {2.25, 2, 1}));
}

// An edge that leaves a corner of a triangle along it, and one that leaves it through the triangle's other side.
TEST(Intersections, OfWhatSharesAVertexAreNotFound) {
  Eigen::MatrixX3d p(5, 3);
  p << right_triangle(), 1, 1, 0, 1, 1, 1;
  TriangleSoup soup;
  soup.add(p, {{0, 1, 2, -1}, {0, 3, 3, -1}});
  EXPECT_TRUE(crossings(soup).empty());
  soup.add(p, {{3, 4, 4, -1}});  // the same places again, but vertices of their own
  EXPECT_EQ(crossings(soup), (std::vector<Crossing>{{0, 3, 2}, {8, 9, 0}, {8, 9, 1}}));
}

// Two triangles of one sheet that have but a corner in common: the side across from it is found.
TEST(Intersections, OfTrianglesThatShareAVertexAreFound) {
  Eigen::MatrixX3d p(5, 3);
  p << right_triangle(), 1, 1, -1, 1, 1, 1;
  TriangleSoup soup;
  soup.add(p, {{0, 1, 2, -1}, {0, 3, 4, -1}});
  EXPECT_EQ(crossings(soup), (std::vector<Crossing>{{3, 4, 0}}));
}

TEST(TriangleSoup, SplitsQuadsFromTheirFirstCornerAndCountsOn) {
  const sim::Mesh grid = quad_grid(2, 2);
  TriangleSoup soup;
  soup.add(grid.position, {{2, 1, 0, -1}});
  soup.add(grid.position, {{0, 2, 3, 1}});
  ASSERT_EQ(soup.position.rows(), 8);
  EXPECT_EQ(soup.position.bottomRows(4), grid.position);
  EXPECT_EQ(soup.triangle, (Eigen::MatrixX3i(3, 3) << 2, 1, 0, 4, 6, 7, 4, 7, 5).finished());
}

TEST(TriangleSoup, OfNothingCrossesNothing) { EXPECT_TRUE(crossings({}).empty()); }

TEST(TriangleSoup, IsRefusedWhereItCannotBeDecided) {
  for (const double x : {std::nan(""), HUGE_VAL, -0x1p301, 0x1p-301, 5e-324}) {
    TriangleSoup soup;
    soup.add(right_triangle(), {{0, 1, 2, -1}});
    soup.position(1, 2) = x;
    EXPECT_THROW(crossings(soup), std::invalid_argument) << x;
  }
}

// A sheet of n x n vertices rolled up: about two turns, whose layers are 0.2 apart.
sim::Mesh roll(int n) {
  sim::Mesh sheet = quad_grid(n, n);
  for (auto p : sheet.position.rowwise()) {
    const double angle = 4.0 * M_PI * p.x() / (n - 1), radius = 1.0 + 0.1 * angle / M_PI;
    p << radius * std::cos(angle), radius * std::sin(angle), p.z() / n;
  }
  return sheet;
}

std::vector<Crossing> crossings_of(const sim::Mesh& mesh, const Eigen::MatrixX3d& position) {
  TriangleSoup soup;
  soup.add(position, mesh.face);
  return crossings(soup);
}

TEST(Intersections, OfASheetFlatOrTiltedOrRolledAreNone) {
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  const sim::Mesh flat = quad_grid(20, 20), rolled = roll(40);
  EXPECT_TRUE(crossings_of(flat, flat.position).empty());
  EXPECT_TRUE(crossings_of(flat, flat.position * tilt).empty());
  EXPECT_TRUE(crossings_of(rolled, rolled.position).empty());
  EXPECT_TRUE(crossings_of(rolled, rolled.position * tilt).empty());
}

// The layer outside is a little nearer than 0.2 between its vertices, being flat there.
TEST(Intersections, OfARollWithOneVertexMovedAreAtThatVertex) {
  const sim::Mesh rolled = roll(40);
  const int moved = 20 * 40 + 5;  // in the inner turn, well inside
  for (const double out : {0.5, 0.9, 1.01, 1.1, 1.5}) {
    SCOPED_TRACE(out);
    Eigen::MatrixX3d position = rolled.position;
    const double radius = position.row(moved).head<2>().norm();
    position.row(moved).head<2>() *= (radius + 0.2 * out) / radius;
    TriangleSoup soup;
    soup.add(position, rolled.face);
    const std::vector<Crossing> found = crossings(soup);
    EXPECT_EQ(found.empty(), out < 1.0);
    for (const Crossing& c : found)
      EXPECT_TRUE(c.edge_a == moved || c.edge_b == moved || (soup.triangle.row(c.triangle).array() == moved).any());
  }
}

// A strip of two quads stands upright through a flat grid, askew of everything. Of the strip three sides and two
// diagonals pass through the grid; of the grid two sides and two diagonals pass through the strip.
TEST(Intersections, OfTwoSheetsThroughOneAnotherAreCounted) {
  const sim::Mesh floor = quad_grid(5, 5);
  sim::Mesh strip = quad_grid(2, 3);
  for (auto p : strip.position.rowwise()) p = Eigen::RowVector3d(1.3, p.x() - 0.5, p.z() + 0.6);
  TriangleSoup soup;
  soup.add(floor.position, floor.face);
  soup.add(strip.position, strip.face);
  const std::vector<Crossing> found = crossings(soup);
  const auto of_strip = std::count_if(found.begin(), found.end(), [](const Crossing& c) { return c.edge_a >= 25; });
  EXPECT_EQ(of_strip, 5);
  EXPECT_EQ(found.size(), 9u);
}

// Two sheets of noise, one over the other, cross as soon as their layers overlap.
TEST(Intersections, OfTwoUnevenSheetsBeginWhereTheyOverlap) {
  const sim::Mesh sheet = quad_grid(12, 12);
  const Eigen::MatrixX3d noise = 0.2 * seeded_noise(sheet.vertices(), 3);
  for (const double gap : {0.5, 0.41, 0.2, 0.0}) {
    SCOPED_TRACE(gap);
    TriangleSoup soup;
    soup.add(sheet.position + noise, sheet.face);
    soup.add((sheet.position - noise).rowwise() + Eigen::RowVector3d(0.0, gap, 0.0), sheet.face);
    EXPECT_EQ(crossings(soup).empty(), gap > 0.4);
  }
}

}  // namespace
}  // namespace billow::test
