// A detection's promise: whoever stays in the cells has passed through nothing.
#include "sim/contact/detection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>

#include "sim/contact/closest_points.h"
#include "tests/support/directions.h"
#include "tests/support/touching_scenes.h"

namespace billow::sim {
namespace {

constexpr double h = 1e-3;  // [s]

/// Two cloths and a mesh that nothing moves, crumpled at random, near each other without crossing.
struct Crumpled {
  explicit Crumpled(std::uint64_t seed) {
    test::Directions random(seed);
    Collider solid;
    solid.name = "solid";
    solid.mesh = test::flat_sheet(4, 4, 0.5, {0.02, -0.02, 0.01});
    scene = test::touching_scene("crumpled",
                                 {{.mesh = test::flat_sheet(8, 8, 0.4, Eigen::Vector3d::Zero())},
                                  {.mesh = test::flat_sheet(7, 6, 0.4, {0.03, 0.02, 0.02})}},
                                 {solid}, 1.0);
    surface.emplace(scene->structure, scene->contact);
    x = surface->rest;
    for (int i = 0; i < surface->particles; ++i) x[i] += 0.008 * random.next();
    for (int i = 0; i < surface->vertices(); ++i)
      v.push_back(i < surface->particles ? Eigen::Vector3d(0.5 * random.next()) : Eigen::Vector3d::Zero());
  }

  std::size_t crossings(const Points& at) const { return test::crossings_of(*surface, at); }

  std::unique_ptr<test::TouchingScene> scene;
  std::optional<ContactSurface> surface;
  Points x, v;
};

TEST(Detection, WhatStaysInItsCellsCrossesNothing) {
  int inside = 0, crossed = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Crumpled crumpled(seed);
    if (crumpled.crossings(crumpled.x) > 0) continue;
    Detection detection(*crumpled.surface);
    detection.detect(crumpled.x, crumpled.v, 0.0, h, 4.0);
    test::Directions random(seed + 1000);
    for (const double size : {0.0001, 0.0003, 0.001, 0.004, 0.02}) {
      Points y = crumpled.x;
      const Eigen::Vector3d together = size * random.next();
      for (int i = 0; i < crumpled.surface->particles; ++i)
        y[i] += 2.0 * h * crumpled.v[i] + together + size * random.next();
      const bool holds = detection.holds(y, 2.0 * h);
      const bool crosses = crumpled.crossings(y) > 0;
      inside += holds, crossed += crosses;
      EXPECT_FALSE(holds && crosses) << "seed " << seed << ", moved by " << size;
    }
  }
  EXPECT_GT(inside, 20);  // neither answer is always the same
  EXPECT_GT(crossed, 20);
}

TEST(Detection, SharesOfAnyWayCrossNothing) {
  int stopped = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Crumpled crumpled(seed);
    if (crumpled.crossings(crumpled.x) > 0) continue;
    Detection detection(*crumpled.surface);
    detection.detect_standing(crumpled.x, crumpled.v, 0.0);
    test::Directions random(seed + 2000);
    Points way(crumpled.x.size(), Eigen::Vector3d::Zero());
    for (int i = 0; i < crumpled.surface->particles; ++i) way[i] = 0.03 * random.next();
    std::vector<double> share;
    const double all = detection.shares(way, share);
    for (const double part : {0.25, 0.5, 1.0}) {
      Points y = crumpled.x;
      for (std::size_t i = 0; i < y.size(); ++i) {
        y[i] += part * std::min(all, share[i]) * way[i];
        stopped += share[i] < 1.0;
      }
      EXPECT_EQ(crumpled.crossings(y), 0u) << "seed " << seed;
    }
  }
  EXPECT_GT(stopped, 100);
}

TEST(Detection, FindsEveryPairOfFeaturesThatIsNear) {
  Crumpled crumpled(3);
  const Body& upper = crumpled.scene->structure.body[1];
  for (int i = upper.first_particle; i < upper.first_particle + upper.particles; ++i) crumpled.x[i](1) -= 0.016;
  Detection detection(*crumpled.surface);
  Points still(crumpled.x.size(), Eigen::Vector3d::Zero());
  detection.detect(crumpled.x, still, 0.0, h, 1.0);
  const auto& surface = *crumpled.surface;
  std::size_t near = 0;
  for (int v = 0; v < surface.vertices(); ++v)
    for (const auto& face : surface.face) {
      if (face[0] == v || face[1] == v || face[2] == v) continue;
      if (!surface.part[surface.part_of[v]].is_body() && !surface.part[surface.part_of[face[0]]].is_body()) continue;
      const double thickness =
          surface.part[surface.part_of[v]].thickness + surface.part[surface.part_of[face[0]]].thickness;
      const Points& x = crumpled.x;
      const Eigen::Vector3d w = nearest_in_triangle(x[v], x[face[0]], x[face[1]], x[face[2]]);
      const double least = (w(0) * x[face[0]] + w(1) * x[face[1]] + w(2) * x[face[2]] - x[v]).norm();
      if (least > 1.2 * thickness) continue;
      ++near;
      const std::array<int, 4> wanted{v, face[0], face[1], face[2]};
      EXPECT_TRUE(std::any_of(detection.pairs().begin(), detection.pairs().end(), [&](const ContactPair& pair) {
        return pair.vertex == wanted;
      })) << v;
    }
  EXPECT_GT(near, 20u);
}

// With how many are the first feature's: a vertex and a triangle may have the same as two edges.
std::set<std::pair<int, std::array<int, 4>>> corners_of(const Detection& detection) {
  std::set<std::pair<int, std::array<int, 4>>> corners;
  for (const ContactPair& pair : detection.pairs()) corners.emplace(pair.on_a, pair.vertex);
  EXPECT_EQ(corners.size(), detection.pairs().size());  // none twice
  return corners;
}

// Most looks go by what an earlier one found, and by what was found around the vertices that are pushed here.
TEST(Detection, LooksThatFollowOthersFindWhatAFirstOneFinds) {
  Crumpled crumpled(5);
  Detection detection(*crumpled.surface);
  test::Directions random(77);
  Points x = crumpled.x, v(x.size(), Eigen::Vector3d::Zero());
  std::size_t found = 0;
  constexpr int looks = 60;
  for (int look = 0; look < looks; ++look) {
    const double time = look * 2.0 * h;
    detection.detect(x, v, time, h, 3.0);
    Detection fresh(*crumpled.surface);
    fresh.detect(x, v, time, h, 3.0);
    EXPECT_EQ(corners_of(detection), corners_of(fresh)) << "look " << look;
    found += fresh.pairs().size();
    for (int i = 0; i < crumpled.surface->particles; ++i) {
      v[i].setZero();
      if ((i + look * 13) % 61 == 0) v[i] = 4.0 * random.next();
      x[i] += 2.0 * h * v[i] + 0.0002 * random.next();
    }
  }
  EXPECT_GT(found, 1000u);
  EXPECT_LT(detection.searches(), looks / 2);
}

}  // namespace
}  // namespace billow::sim
