// Shapes: their measures, that they are closed and face outwards, and where their texture lies.
#include "sim/mesh/shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <numbers>

#include "sim/mesh/closed_surface.h"
#include "sim/mesh/mesh_edges.h"

namespace billow::sim {
namespace {

constexpr double pi = std::numbers::pi;

// As contact and pictures cut quads, which are flat here.
double area(const Mesh& mesh) {
  double sum = 0.0;
  const auto at = [&](int v) -> Eigen::Vector3d { return mesh.position.row(v); };
  for (const Face& face : mesh.face)
    for (int c = 1; c + 1 < corner_count(face); ++c)
      sum += 0.5 * (at(face[c]) - at(face[0])).cross(at(face[c + 1]) - at(face[0])).norm();
  return sum;
}

int euler_characteristic(const Mesh& mesh) {
  return mesh.vertices() - static_cast<int>(distinct_edges(mesh).size()) + static_cast<int>(mesh.face.size());
}

struct Shape {
  const char* name;
  Mesh mesh;
  double volume, area;  // of the shape itself [m^3, m^2]
  double share;         // of both that faces inside the surface may miss
};

std::vector<Shape> shapes() {
  const Eigen::Vector3d a(0.3, -0.2, 1.0), b(-0.5, 0.7, 0.4);
  const double r = 0.25, l = (b - a).norm();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return {{"sphere", sphere_mesh(a, r), 4.0 / 3.0 * pi * r * r * r, 4.0 * pi * r * r, 0.004},
          {"capsule", capsule_mesh(a, b, r), pi * r * r * (4.0 / 3.0 * r + l), 2.0 * pi * r * (2.0 * r + l), 0.004},
          {"thin capsule", capsule_mesh(a, b, 0.01), pi * 1e-4 * (0.04 / 3.0 + l), 0.02 * pi * (0.02 + l), 0.015},
          {"cylinder", cylinder_mesh(a, b, r), pi * r * r * l, 2.0 * pi * r * (r + l), 0.004},
          {"table top", cylinder_mesh({0, 0.7, 0}, {0, 0.73, 0}, 0.5), pi * 0.25 * 0.03, 2 * pi * 0.5 * 0.53, 0.004},
          {"hanging", cylinder_mesh({0, 1, 0}, {0, 0, 0}, 0.5), pi * 0.25, 2 * pi * 0.5 * 1.5, 0.004},
          {"box", box_mesh(a, {1.0, 0.05, 0.6}, turn), 0.03, 2.0 * (0.05 + 0.6 + 0.03), 1e-12}};
}

TEST(Shapes, HaveTheirVolumeAndArea) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    EXPECT_NEAR(enclosed_volume(shape.mesh), shape.volume, shape.share * shape.volume);  // positive: faces outwards
    EXPECT_NEAR(area(shape.mesh), shape.area, shape.share * shape.area);
  }
}

TEST(Shapes, AreClosedBalls) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    EXPECT_NO_THROW(require_solid(shape.mesh));
    EXPECT_EQ(euler_characteristic(shape.mesh), 2);
  }
}

TEST(Shapes, HaveEvenFaces) {
  for (const Shape& shape : {shapes()[0], shapes()[1], shapes()[3]}) {
    SCOPED_TRACE(shape.name);
    const double mean = mean_edge_length(shape.mesh);
    for (const Edge& edge : distinct_edges(shape.mesh)) {
      const double length = (shape.mesh.position.row(edge.second) - shape.mesh.position.row(edge.first)).norm();
      ASSERT_GT(length, 0.5 * mean);
      ASSERT_LT(length, 2.0 * mean);
    }
  }
}

TEST(Shapes, HaveTextureCoordinatesInTheUnitSquare) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    ASSERT_EQ(shape.mesh.uv.size(), shape.mesh.face.size());
    float least = 1.0f, most = 0.0f;
    for (std::size_t f = 0; f < shape.mesh.uv.size(); ++f)
      for (int c = 0; c < corner_count(shape.mesh.face[f]); ++c) {
        least = std::min(least, shape.mesh.uv[f][c].minCoeff());
        most = std::max(most, shape.mesh.uv[f][c].maxCoeff());
      }
    EXPECT_NEAR(least, 0.0f, 1e-6f);
    EXPECT_NEAR(most, 1.0f, 1e-6f);
  }
}

// Read as one reads a picture that is wrapped around: no face mirrors it, none spans the seam the wrong way.
TEST(Shapes, WrapTheirTextureWithoutMirroringIt) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    for (const auto& uv : shape.mesh.uv) {
      const Eigen::Vector2f right = uv[1] - uv[0], up = uv[2] - uv[0];
      ASSERT_GT(right.x() * up.y() - right.y() * up.x(), 0.0f);
    }
  }
}

TEST(Shapes, SphereShowsTheTexturesMiddleInFront) {
  const Mesh sphere = sphere_mesh(Eigen::Vector3d::Zero(), 1.0);
  for (std::size_t f = 0; f < sphere.face.size(); ++f)
    for (int c = 0; c < corner_count(sphere.face[f]); ++c) {
      const Eigen::Vector2f uv = sphere.uv[f][c];
      const Eigen::Vector3d place = sphere.position.row(sphere.face[f][c]);
      ASSERT_NEAR(place.norm(), 1.0, 1e-12);
      ASSERT_NEAR(uv.y(), std::acos(-place.y()) / pi, 1e-6);
      if (std::abs(place.y()) < 0.999) {
        ASSERT_NEAR(std::sin(2.0 * pi * (uv.x() - 0.5)), place.x() / std::hypot(place.x(), place.z()), 1e-5);
        ASSERT_NEAR(std::cos(2.0 * pi * (uv.x() - 0.5)), place.z() / std::hypot(place.x(), place.z()), 1e-5);
      }
    }
}

}  // namespace
}  // namespace billow::sim
