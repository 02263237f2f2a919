// Shapes around an axis are rings of points, each with as many as its circumference wants; between two rings runs a
// strip of triangles, or of quads where they have as many. All rings begin at the same angle: there is the texture's
// seam.
#include "sim/mesh/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace billow::sim {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int most_around = 80, least_around = 24;  // points of the widest ring
constexpr int most_along = 80;                      // strips along an axis
constexpr int least_points = 6;                     // of a ring that is no pole
constexpr int box_cells = 16;                       // along a box's longest side

/// A ring of a shape around the y axis; one with a single point is a pole.
struct Ring {
  double radius, height;  // [m]
  double v;               // texture coordinate where the texture goes around
  int points = 0, first = 0;
};

/// Where a strip's texture coordinates come from.
enum class Texture { around, from_above, from_below };

class Revolution {
 public:
  /// `edge` [m] is the wanted distance between points, `widest` [m] the radius that textures on flat ends span.
  Revolution(double edge, double widest) : edge_(edge), widest_(widest) {}

  /// The next ring upwards along the outline, as seen from outside.
  void add(double radius, double height, double v) {
    const int points =
        radius > 0.0 ? std::max(least_points, static_cast<int>(std::lround(2.0 * pi * radius / edge_))) : 1;
    add(radius, height, v, points);
  }
  /// The same with a number of points.
  void add(double radius, double height, double v, int points) {
    const Ring ring{radius, height, v, points, static_cast<int>(position_.size())};
    for (int k = 0; k < points; ++k) position_.push_back(place(ring, k));
    ring_.push_back(ring);
  }

  /// The strip between the ring that was added last and the one before it.
  void join(Texture texture) {
    const Ring &lower = ring_[ring_.size() - 2], &upper = ring_.back();
    texture_ = texture;
    if (lower.points == upper.points)
      quads(lower, upper);
    else
      triangles(lower, upper);
  }

  /// Turned and moved: its y axis along `axis` (unit), its origin at `origin` [m].
  Mesh mesh(const Eigen::Vector3d& axis, const Eigen::Vector3d& origin) const {
    const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), axis).toRotationMatrix();
    Mesh result;
    result.position.resize(static_cast<Eigen::Index>(position_.size()), 3);
    for (std::size_t p = 0; p < position_.size(); ++p)
      result.position.row(static_cast<Eigen::Index>(p)) = turn * position_[p] + origin;
    result.face = face_;
    result.uv = uv_;
    return result;
  }

 private:
  using Corner = std::pair<const Ring*, double>;  // a ring, and which of its points; points of it are the first again

  // From +z towards +x, so that the texture's u grows to the right as seen from outside.
  static double angle(const Ring& ring, double k) { return 2.0 * pi * (k / ring.points - 0.5); }

  static Eigen::Vector3d place(const Ring& ring, double k) {
    return {ring.radius * std::sin(angle(ring, k)), ring.height, ring.radius * std::cos(angle(ring, k))};
  }

  Eigen::Vector2f uv(const Corner& corner) const {
    const auto& [ring, k] = corner;
    const double turned = ring->points > 1 ? k / ring->points : k;  // a pole's corner says its u itself
    if (texture_ == Texture::around) return Eigen::Vector2d(turned, ring->v).cast<float>();
    const Eigen::Vector3d flat = place(*ring, k) / widest_;
    const double up = texture_ == Texture::from_above ? -flat.z() : flat.z();
    return Eigen::Vector2d(0.5 + 0.5 * flat.x(), 0.5 + 0.5 * up).cast<float>();
  }

  void face(const std::vector<Corner>& corners) {
    Face face{-1, -1, -1, -1};
    std::array<Eigen::Vector2f, 4> uvs;
    uvs.fill(Eigen::Vector2f::Zero());
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Ring& ring = *corners[c].first;
      face[c] = ring.points > 1 ? ring.first + static_cast<int>(corners[c].second) % ring.points : ring.first;
      uvs[c] = uv(corners[c]);
    }
    face_.push_back(face);
    uv_.push_back(uvs);
  }

  void quads(const Ring& lower, const Ring& upper) {
    for (int k = 0; k < lower.points; ++k) face({{&lower, k}, {&lower, k + 1}, {&upper, k + 1}, {&upper, k}});
  }

  // Goes around on both rings at once, always on to the nearer of the two next points.
  void triangles(const Ring& lower, const Ring& upper) {
    const auto steps = [](const Ring& ring) { return ring.points > 1 ? ring.points : 0; };
    const int lower_steps = steps(lower), upper_steps = steps(upper);
    for (int i = 0, j = 0; i < lower_steps || j < upper_steps;) {
      const double pole_u = (0.5 + i + j) / std::max(lower_steps, upper_steps);  // the middle of its triangle
      const auto at = [&](const Ring& ring, int k) { return Corner{&ring, ring.points > 1 ? k : pole_u}; };
      if ((i + 1) * upper_steps <= (j + 1) * lower_steps) {
        face({at(lower, i), at(lower, i + 1), at(upper, j)});
        ++i;
      } else {
        face({at(lower, i), at(upper, j + 1), at(upper, j)});
        ++j;
      }
    }
  }

  double edge_, widest_;  // [m]
  std::vector<Ring> ring_;
  std::vector<Eigen::Vector3d> position_;
  std::vector<Face> face_;
  std::vector<std::array<Eigen::Vector2f, 4>> uv_;
  Texture texture_ = Texture::around;
};

/// How finely a round shape is cut.
struct Fineness {
  double edge;  // [m]
  int around;   // points of its widest ring
  int along;    // strips along its straight part
};

// A thin and long one has its faces longer than wide, or it would have too many.
Fineness fineness(double radius, double length) {
  const double edge = std::max(2.0 * pi * radius / most_around, length / most_along);
  const int around = std::clamp(static_cast<int>(std::lround(2.0 * pi * radius / edge)), least_around, most_around);
  return {2.0 * pi * radius / around, around, std::clamp(static_cast<int>(std::ceil(length / edge)), 1, most_along)};
}

// Strips over a quarter of a circle whose widest ring has `around` points.
int quarter_strips(int around) { return around / 4; }

}  // namespace

Mesh sphere_mesh(const Eigen::Vector3d& centre, double radius) {
  const Fineness fine = fineness(radius, 0.0);
  const int strips = 2 * quarter_strips(fine.around);
  Revolution sphere(fine.edge, radius);
  for (int k = 0; k <= strips; ++k) {
    const double v = double(k) / strips;
    const bool pole = k == 0 || k == strips;
    sphere.add(pole ? 0.0 : radius * std::sin(pi * v), -radius * std::cos(pi * v), v);
    if (k > 0) sphere.join(Texture::around);
  }
  return sphere.mesh(Eigen::Vector3d::UnitY(), centre);
}

Mesh capsule_mesh(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  const double length = (to - from).norm();
  const Fineness fine = fineness(radius, length);
  const int strips = quarter_strips(fine.around);
  const double outline = pi * radius + length;
  Revolution capsule(fine.edge, radius);
  const auto dome = [&](int k, double height, double below) {  // k strips from the lower pole of its sphere
    const double turned = 0.5 * pi * k / strips;
    const double v = (radius * turned + below) / outline;
    if (k == strips)
      capsule.add(radius, height, v, fine.around);
    else
      capsule.add(k == 0 || k == 2 * strips ? 0.0 : radius * std::sin(turned), height - radius * std::cos(turned), v);
    if (v > 0.0) capsule.join(Texture::around);
  };
  for (int k = 0; k <= strips; ++k) dome(k, 0.0, 0.0);
  for (int k = 1; k < fine.along; ++k) dome(strips, length * k / fine.along, length * k / fine.along);
  for (int k = strips; k <= 2 * strips; ++k) dome(k, length, length);
  return capsule.mesh((to - from) / length, from);
}

Mesh cylinder_mesh(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  const double length = (to - from).norm();
  const Fineness fine = fineness(radius, length);
  const int rings = static_cast<int>(std::lround(radius / fine.edge));
  Revolution cylinder(fine.edge, radius);
  const auto end = [&](int k, double height) {  // k rings from the middle
    if (k == rings)
      cylinder.add(radius, height, height / length, fine.around);
    else
      cylinder.add(radius * k / rings, height, height / length);
  };
  for (int k = 0; k <= rings; ++k) {
    end(k, 0.0);
    if (k > 0) cylinder.join(Texture::from_below);
  }
  for (int k = 1; k <= fine.along; ++k) {
    end(rings, length * k / fine.along);
    cylinder.join(Texture::around);
  }
  for (int k = rings - 1; k >= 0; --k) {
    end(k, length);
    cylinder.join(Texture::from_above);
  }
  return cylinder.mesh((to - from) / length, from);
}

namespace {

/// One side of a box, facing along +-`axis`, as a grid of cells of its own points.
void add_side(PolygonSoup& soup, const Eigen::Vector3d& size, const Eigen::Vector3i& cells, int axis, bool far) {
  // Right and up on the side as seen from outside: right x up = +-axis.
  const int right = (axis + (far ? 1 : 2)) % 3, up = (axis + (far ? 2 : 1)) % 3;
  const int first = static_cast<int>(soup.position.rows()), columns = cells(right) + 1, rows = cells(up) + 1;
  soup.position.conservativeResize(first + columns * rows, Eigen::NoChange);
  soup.uv.conservativeResize(first + columns * rows, Eigen::NoChange);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const Eigen::Vector2d place(double(i) / cells(right), double(j) / cells(up));
      Eigen::Vector3d share = Eigen::Vector3d::Constant(far ? 0.5 : -0.5);
      share(right) = place.x() - 0.5;
      share(up) = place.y() - 0.5;
      soup.position.row(first + j * columns + i) = share.cwiseProduct(size);
      soup.uv.row(first + j * columns + i) = place.cast<float>();
    }
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int corner = first + j * columns + i;
      soup.face.push_back({corner, corner + 1, corner + columns + 1, corner + columns});
    }
}

}  // namespace

Mesh box_mesh(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, const Eigen::Matrix3d& rotation) {
  const double edge = size.maxCoeff() / box_cells;
  const Eigen::Vector3i cells = (size / edge).array().ceil().cwiseMin(box_cells).cast<int>();
  PolygonSoup soup;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) add_side(soup, size, cells, axis, far);
  return transformed(weld(soup), rotation, centre);
}

}  // namespace billow::sim
