// The fish's structure: counts, symmetry, the step limit, and how it goes with the length.
#include "sim/body/fish.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "sim/force/spring_force.h"
#include "sim/linear/max_eigenvalue.h"
#include "tests/support/swimmers.h"

namespace billow {
namespace {

using sim::SpringKind;

TEST(Fish, HasTheParticlesAndUnitsOfTuAndTerzopoulos) {
  const sim::Structure fish = sim::build_fish({});
  std::map<SpringKind, int> count;
  std::set<std::pair<int, int>> pairs;
  for (int s = 0; s < fish.springs(); ++s) {
    ++count[fish.kind[s]];
    pairs.insert({fish.spring(s, 0), fish.spring(s, 1)});
    EXPECT_LT(fish.spring(s, 0), fish.spring(s, 1));
  }
  EXPECT_EQ(fish.particles(), 23);
  EXPECT_EQ(fish.springs(), 91);
  EXPECT_EQ(pairs.size(), 91u);
  EXPECT_EQ(count[SpringKind::cross], 46);
  EXPECT_EQ(count[SpringKind::normal], 33);
  EXPECT_EQ(count[SpringKind::muscle], 12);
  EXPECT_NEAR(fish.mass.sum(), 1.1 + 4 * (6.6 + 11.0 + 6.6) + 8 * 1.1 + 2 * 0.165, 1e-9);
}

TEST(Fish, HasTwoMusclesOnEachSideOfEachSegment) {
  std::map<std::pair<int, sim::Side>, int> count;
  const sim::Structure fish = sim::build_fish({});
  for (const sim::Muscle& muscle : sim::fish_muscles()) {
    ++count[{muscle.segment, muscle.side}];
    EXPECT_EQ(fish.kind[muscle.spring], SpringKind::muscle);
    for (int end = 0; end < 2; ++end)
      EXPECT_EQ(fish.rest_position(fish.spring(muscle.spring, end), 2) > 0.0, muscle.side == sim::Side::right);
  }
  EXPECT_EQ(count.size(), 6u);
  for (const auto& [place, muscles] : count) EXPECT_EQ(muscles, 2);
}

// The particle at the mirror image of each particle.
std::vector<int> mirrored(const sim::Structure& fish) {
  std::vector<int> image;
  for (int i = 0; i < fish.particles(); ++i)
    for (int j = 0; j < fish.particles(); ++j) {
      const Eigen::RowVector3d difference =
          fish.rest_position.row(i) - fish.rest_position.row(j).cwiseProduct(Eigen::RowVector3d(1, 1, -1));
      if (difference.norm() < 1e-12) image.push_back(j);
    }
  return image;
}

TEST(Fish, IsItsOwnMirrorImage) {
  const sim::Structure fish = sim::build_fish({});
  const std::vector<int> image = mirrored(fish);
  ASSERT_EQ(image.size(), 23u);
  std::map<std::pair<int, int>, SpringKind> kind;
  for (int s = 0; s < fish.springs(); ++s) kind[{fish.spring(s, 0), fish.spring(s, 1)}] = fish.kind[s];
  for (int s = 0; s < fish.springs(); ++s) {
    const auto pair = std::minmax(image[fish.spring(s, 0)], image[fish.spring(s, 1)]);
    ASSERT_TRUE(kind.contains(pair));
    EXPECT_EQ(kind[pair], fish.kind[s]);
  }
}

TEST(Fish, LimitsFbEulerToTheKnownStep) {
  for (const sim::FishOptions& options : {sim::FishOptions{}, test::swimmer_options()}) {
    const sim::Structure fish = sim::build_fish(options);
    const auto k0 = sim::max_eigenvalue(fish, sim::linearise_at_rest(fish).stiffness);
    ASSERT_TRUE(k0.converged);
    EXPECT_NEAR(2.0 / std::sqrt(k0.value), 0.063, 0.02 * 0.063);
  }
}

// m ~ s^3, k ~ s, c ~ s^2 and faces ~ s^2: lengths and times scale with s alike.
TEST(Fish, SwimsAlikeAtEveryLength) {
  const test::Swimmer large(test::swimming());
  sim::MotionOptions hurried = test::swimming(2.0 * 1.34);
  hurried.transition /= 2.0;
  const test::Swimmer small(hurried, test::swimmer_options(0.5));
  sim::SolverOptions fine, finer;
  fine.step = 0.02, finer.step = 0.01;
  EXPECT_TRUE(small.at(1.0, finer).position.isApprox(0.5 * large.at(2.0, fine).position, 1e-9));
}

TEST(Fish, LooksWhereItIsTurned) {
  sim::FishOptions options;
  options.rotation << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // a quarter to the left
  options.position = {1.0, 2.0, 3.0};
  const sim::Structure fish = sim::build_fish(options);
  const Eigen::RowVector3d along =
      fish.rest_position.row(sim::fish_snout()) - fish.rest_position.row(sim::fish_tail_tip(sim::Level::dorsal));
  EXPECT_LT(along.z(), -1.5);
  EXPECT_NEAR(along.x(), 0.0, 1e-12);
}

// Each edge once in each direction, and a positive volume.
TEST(FishFaces, AreClosedAndFaceOutwards) {
  const Eigen::MatrixX3d x = sim::build_fish({}).rest_position;
  std::map<std::pair<int, int>, int> edge;
  double volume = 0.0;
  for (const sim::Face& face : sim::fish_faces()) {
    const int corners = sim::corner_count(face);
    for (int c = 0; c < corners; ++c) ++edge[{face[c], face[(c + 1) % corners]}];
    for (int c = 1; c + 1 < corners; ++c) {
      const Eigen::Vector3d a = x.row(face[0]), b = x.row(face[c]), d = x.row(face[c + 1]);
      volume += a.dot(b.cross(d)) / 6.0;
    }
  }
  for (const auto& [ends, times] : edge) {
    EXPECT_EQ(times, 1);
    EXPECT_EQ(edge.count({ends.second, ends.first}), 1u);
  }
  EXPECT_GT(volume, 0.0);
}

}  // namespace
}  // namespace billow
