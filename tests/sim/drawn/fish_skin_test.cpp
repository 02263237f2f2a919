// The drawn fish follows its particles: exact at rest, whole and smooth in motion.
#include "sim/drawn/fish_skin.h"

#include <gtest/gtest.h>

#include <map>

#include "sim/body/cloth.h"
#include "sim/drawn/cubic_spline.h"
#include "sim/import/mesh_import.h"
#include "tests/support/swimmers.h"

namespace billow {
namespace {

const sim::Mesh& fish_mesh() {
  static const sim::Mesh mesh = sim::import_mesh(BILLOW_SOURCE_DIR "/assets/meshes/fish.obj");
  return mesh;
}

double volume(const sim::Surface& surface, const sim::SurfaceState& state) {
  double sum = 0.0;
  for (Eigen::Index t = 0; t < surface.triangle.rows(); ++t) {
    const auto point = [&](int c) -> Eigen::Vector3d {
      return state.position.row(surface.point(surface.triangle(t, c))).cast<double>();
    };
    sum += point(0).dot(point(1).cross(point(2))) / 6.0;
  }
  return sum;
}

TEST(FishMesh, IsClosedAndFineEnough) {
  const sim::Surface surface = sim::build_surface(fish_mesh());
  EXPECT_GE(surface.triangle.rows(), 2000);
  std::map<std::pair<int, int>, int> edge;
  for (Eigen::Index t = 0; t < surface.triangle.rows(); ++t)
    for (int c = 0; c < 3; ++c)
      ++edge[{surface.point(surface.triangle(t, c)), surface.point(surface.triangle(t, (c + 1) % 3))}];
  for (const auto& [ends, times] : edge) {
    const auto back = edge.find({ends.second, ends.first});
    ASSERT_TRUE(back != edge.end());
    ASSERT_EQ(times, back->second);
  }
}

TEST(FishSkin, IsTheMeshAtRest) {
  const sim::Skin skin = sim::bind_fish_skin(fish_mesh(), 1.0);
  const sim::Structure fish = sim::build_fish(test::swimmer_options());
  const sim::SurfaceState at_rest = sim::pose(skin, fish.body[0], sim::rest_state(fish));
  EXPECT_LT((at_rest.position.cast<double>() - fish_mesh().position).cwiseAbs().maxCoeff(), 2e-6);
  EXPECT_LT((skin.middle.rowwise().sum().array() - 1.0f).abs().maxCoeff(), 1e-5f);
}

TEST(FishSkin, MovesRigidlyWithRigidMotion) {
  const sim::Skin skin = sim::bind_fish_skin(fish_mesh(), 1.0);
  sim::FishOptions options = test::swimmer_options();
  options.rotation = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  options.position = {0.5, -0.2, 1.0};
  const sim::Structure fish = sim::build_fish(options);
  const sim::SurfaceState state = sim::pose(skin, fish.body[0], sim::rest_state(fish));
  const Eigen::MatrixX3d expected =
      (fish_mesh().position * options.rotation.transpose()).rowwise() + options.position.transpose();
  EXPECT_LT((state.position.cast<double>() - expected).cwiseAbs().maxCoeff(), 3e-6);
}

// No twist or pinch anywhere in a swim: the volume shrinks no more than muscles shorten the body, and smoothly.
TEST(FishSkin, KeepsItsVolumeWhileSwimming) {
  const sim::Skin skin = sim::bind_fish_skin(fish_mesh(), 1.0);
  const test::Swimmer fish(test::turning(0.3));
  sim::SolverOptions options;
  options.step = 0.05;
  sim::Solver solver(fish.structure, *fish.forces, options, sim::rest_state(fish.structure));
  const double rest = volume(skin.surface, sim::pose(skin, fish.structure.body[0], solver.state()));
  double last = rest;
  for (int frame = 1; frame <= 150; ++frame) {
    const double now = volume(skin.surface, sim::pose(skin, fish.structure.body[0], solver.sample(frame / 25.0)));
    EXPECT_NEAR(now, rest, 0.33 * rest);
    EXPECT_NEAR(now, last, 0.05 * rest);
    last = now;
  }
}

TEST(FishSkin, HasTheVelocityOfItsMotion) {
  const sim::Skin skin = sim::bind_fish_skin(fish_mesh(), 1.0);
  const test::Swimmer fish(test::swimming());
  sim::State state = fish.at(1.0), later = state;
  later.position += 1e-3 * state.velocity;
  const sim::SurfaceState a = sim::pose(skin, fish.structure.body[0], state);
  const sim::SurfaceState b = sim::pose(skin, fish.structure.body[0], later);
  EXPECT_LT(((b.position - a.position) / 1e-3f - a.velocity).cwiseAbs().maxCoeff(), 5e-3f);
}

TEST(CubicSpline, InterpolatesAndIsExactForLines) {
  const Eigen::VectorXd knot = Eigen::VectorXd::Map(std::array{0.0, 0.3, 0.5, 1.1}.data(), 4);
  for (int k = 0; k < 4; ++k) EXPECT_TRUE(sim::spline_weights(knot, knot(k)).isApprox(Eigen::VectorXd::Unit(4, k)));
  for (const double x : {-0.7, 0.1, 0.4, 0.9, 2.0}) {
    EXPECT_NEAR(sim::spline_weights(knot, x).dot(3.0 * knot + Eigen::VectorXd::Ones(4)), 3.0 * x + 1.0, 1e-12);
    EXPECT_NEAR(sim::spline_weights(knot, x).sum(), 1.0, 1e-12);
  }
}

// First derivatives from both sides of a knot agree, and second ones too.
TEST(CubicSpline, IsSmoothAtItsKnots) {
  const Eigen::VectorXd knot = Eigen::VectorXd::Map(std::array{0.0, 0.3, 0.5, 1.1}.data(), 4);
  const Eigen::VectorXd value = Eigen::VectorXd::Map(std::array{1.0, -0.5, 2.0, 0.3}.data(), 4);
  constexpr double d = 1e-4;
  const auto at = [&](double x) { return sim::spline_weights(knot, x).dot(value); };
  for (const double x : {0.3, 0.5}) {
    const double before = (at(x) - at(x - d)) / d, after = (at(x + d) - at(x)) / d;
    EXPECT_NEAR(before, after, 0.05);
    const double bend_before = (at(x) - 2 * at(x - d) + at(x - 2 * d)) / (d * d);
    const double bend_after = (at(x + 2 * d) - 2 * at(x + d) + at(x)) / (d * d);
    EXPECT_NEAR(bend_before, bend_after, 0.1 * std::abs(bend_before) + 0.5);
  }
}

}  // namespace
}  // namespace billow
