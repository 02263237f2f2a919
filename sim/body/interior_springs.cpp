// Rays through the inside of a closed mesh, found by a tree of boxes over its triangles.
#include "sim/body/interior_springs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <unsupported/Eigen/BVH>

#include "base/parallel.h"
#include "sim/mesh/closed_surface.h"

namespace billow::sim {
namespace {

using Box = Eigen::AlignedBox3d;
using Triangle = std::array<int, 3>;
using Tree = Eigen::KdBVH<double, 3, int>;

// A ray may miss a triangle by this share of its size and still meet it, so that none slips between two.
constexpr double edge_tolerance = 1e-9;

constexpr std::size_t rays_per_vertex = 5;

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> triangles;
  for (const Face& face : mesh.face)
    for (int c = 1; c + 1 < corner_count(face); ++c) triangles.push_back({face[0], face[c], face[c + 1]});
  return triangles;
}

Box box_of(const Mesh& mesh, const Triangle& triangle) {
  Box box;
  for (const int v : triangle) box.extend(mesh.position.row(v).transpose());
  const double margin = edge_tolerance * box.diagonal().norm();
  return Box(box.min().array() - margin, box.max().array() + margin);
}

/// Walks the tree along the ray origin + t direction, t > 0, and keeps the first triangle that it meets.
class FirstHit {
 public:
  FirstHit(const Mesh& mesh, const std::vector<Triangle>& triangles, int origin, const Eigen::Vector3d& direction)
      : mesh_(mesh), triangles_(triangles), vertex_(origin), origin_(place(origin)), direction_(direction) {}

  // Slabs: the ray is in the box between the last entry and the first exit of the three axes.
  bool intersectVolume(const Box& box) const {
    double entry = 0.0, exit = distance_;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction_(axis) == 0.0) {
        if (origin_(axis) < box.min()(axis) || origin_(axis) > box.max()(axis)) return false;
        continue;
      }
      const double low = (box.min()(axis) - origin_(axis)) / direction_(axis);
      const double high = (box.max()(axis) - origin_(axis)) / direction_(axis);
      entry = std::max(entry, std::min(low, high));
      exit = std::min(exit, std::max(low, high));
    }
    return entry <= exit;
  }

  // Moeller and Trumbore: origin + t direction = a + u (b - a) + v (c - a) by Cramer's rule. Of triangles equally far,
  // as at a shared edge, the one with the lowest number counts. Never stops the walk.
  bool intersectObject(int number) {
    const Triangle& triangle = triangles_[static_cast<std::size_t>(number)];
    if (std::find(triangle.begin(), triangle.end(), vertex_) != triangle.end()) return false;
    const Eigen::Vector3d a = place(triangle[0]), ab = place(triangle[1]) - a, ac = place(triangle[2]) - a;
    const Eigen::Vector3d across = direction_.cross(ac);
    const double determinant = ab.dot(across);
    if (determinant == 0.0) return false;
    const Eigen::Vector3d way = origin_ - a, turned = way.cross(ab);
    const double u = way.dot(across) / determinant, v = direction_.dot(turned) / determinant;
    const double t = ac.dot(turned) / determinant;
    const bool inside = u >= -edge_tolerance && v >= -edge_tolerance && u + v <= 1.0 + edge_tolerance;
    if (inside && t > 0.0 && (t < distance_ || (t == distance_ && number < hit_))) distance_ = t, hit_ = number;
    return false;
  }

  /// The corner nearest to where the ray came out, or -1 where it met nothing.
  int corner() const {
    if (hit_ < 0) return -1;
    const Triangle& triangle = triangles_[static_cast<std::size_t>(hit_)];
    const Eigen::Vector3d exit = origin_ + distance_ * direction_;
    const auto nearer = [&](int a, int b) { return (place(a) - exit).squaredNorm() < (place(b) - exit).squaredNorm(); };
    return *std::min_element(triangle.begin(), triangle.end(), nearer);
  }

 private:
  Eigen::Vector3d place(int vertex) const { return mesh_.position.row(vertex); }

  const Mesh& mesh_;
  const std::vector<Triangle>& triangles_;
  int vertex_;
  Eigen::Vector3d origin_, direction_;
  double distance_ = std::numeric_limits<double>::infinity();
  int hit_ = -1;
};

// Straight inwards, and at 45 degrees to that towards and away from a neighbour and to both sides of it: the mesh
// itself decides, so that the directions turn with it.
std::array<Eigen::Vector3d, rays_per_vertex> inward_rays(const Eigen::Vector3d& normal,
                                                         const Eigen::Vector3d& to_neighbour) {
  const Eigen::Vector3d inward = -normal;
  const Eigen::Vector3d flat = to_neighbour - to_neighbour.dot(normal) * normal;
  const Eigen::Vector3d along = flat.norm() > 0.0 ? flat.normalized() : normal.unitOrthogonal();
  const Eigen::Vector3d aside = normal.cross(along);
  return {inward, (inward + along).normalized(), (inward - along).normalized(), (inward + aside).normalized(),
          (inward - aside).normalized()};
}

// For each vertex, the next corner of its first face.
std::vector<int> a_neighbour_of_each(const Mesh& mesh) {
  std::vector<int> neighbour(static_cast<std::size_t>(mesh.vertices()), -1);
  for (const Face& face : mesh.face)
    for (int c = 0; c < corner_count(face); ++c)
      if (int& known = neighbour[face[c]]; known < 0) known = face[(c + 1) % corner_count(face)];
  return neighbour;
}

}  // namespace

std::vector<InteriorRay> interior_rays(const Mesh& mesh) {
  const std::vector<Triangle> triangles = triangles_of(mesh);
  std::vector<int> number(triangles.size());
  std::vector<Box> box;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    number[t] = static_cast<int>(t);
    box.push_back(box_of(mesh, triangles[t]));
  }
  const Tree tree(number.begin(), number.end(), box.begin(), box.end());
  const Eigen::MatrixX3d normal = outward_normals(mesh);
  const std::vector<int> neighbour = a_neighbour_of_each(mesh);
  std::vector<std::array<int, rays_per_vertex>> corner(static_cast<std::size_t>(mesh.vertices()));
  for_each_range(mesh.vertices(), 1, least_part_of_a_pass, [&](int, int begin, int end) {
    for (int v = begin; v < end; ++v) {
      const Eigen::Vector3d to_neighbour = (mesh.position.row(neighbour[v]) - mesh.position.row(v)).transpose();
      const auto rays = inward_rays(normal.row(v), to_neighbour);
      for (std::size_t r = 0; r < rays.size(); ++r) {
        FirstHit hit(mesh, triangles, v, rays[r]);
        Eigen::BVIntersect(tree, hit);
        corner[v][r] = hit.corner();
      }
    }
  });
  std::vector<InteriorRay> rays;
  for (int v = 0; v < mesh.vertices(); ++v)
    for (std::size_t r = 0; r < rays_per_vertex; ++r)
      if (corner[v][r] >= 0) rays.push_back({v, corner[v][r], r == 0});
  return rays;
}

std::vector<std::pair<int, int>> interior_pairs(const Mesh& mesh) {
  std::vector<std::pair<int, int>> pairs;
  for (const InteriorRay& ray : interior_rays(mesh)) pairs.push_back(std::minmax(ray.from, ray.to));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace billow::sim
