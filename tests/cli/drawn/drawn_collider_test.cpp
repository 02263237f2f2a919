// Colliders among what is drawn: where they are, how fast, and what of them a picture frames.
#include "cli/drawn/drawn_collider.h"

#include <gtest/gtest.h>

#include "cli/drawn/drawn_scene.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

/// A scene of one cloth of a square metre around the origin, and of colliders.
class DrawnColliders : public testing::Test {
 protected:
  void read(const std::string& colliders, const std::string& rest = "") {
    scene_.emplace(cli::read_scene(
        folder_.scene("billow: 1\nbodies: [{name: sheet, cloth: {mesh: cloth.obj}, contact: none}]\ncolliders: [" +
                      colliders + "]\n" + rest)));
    simulation_.emplace(*scene_);
    drawn_.emplace(*scene_, *simulation_);
  }
  sim::State at(double time) const {
    sim::State state = simulation_->initial_state();
    state.time = time;
    return state;
  }

  test::SceneFolder folder_;
  std::optional<cli::Scene> scene_;
  std::optional<cli::Simulation> simulation_;
  std::optional<cli::DrawnScene> drawn_;
};

TEST_F(DrawnColliders, ComeAfterTheBodiesAndBeforeTheMotes) {
  read("{sphere: {radius: 0.1}, colour: \"#ff0000\"}, {plane: {height: -1}}", "water: {motes: 5}\n");
  const std::vector<render::DrawnBody> bodies = drawn_->bodies();
  const std::vector<sim::SurfaceState> states = drawn_->surfaces(at(0.0));
  ASSERT_EQ(bodies.size(), 4u);
  ASSERT_EQ(states.size(), 4u);
  EXPECT_EQ(bodies[1].finish[0].colour, Eigen::Vector3f(1.0f, 0.0f, 0.0f));
  for (std::size_t b = 0; b < 4; ++b) EXPECT_EQ(states[b].position.rows(), bodies[b].surface.points());
  EXPECT_EQ(bodies[3].surface.points(), 5 * 6);
  for (std::size_t b = 0; b < 4; ++b) EXPECT_EQ(bodies[b].scenery, b == 3);
}

TEST_F(DrawnColliders, LookAsTheirMeshesDo) {
  folder_.write("two.obj",
                "mtllib two.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nv 2 0 0 1 1 1\n"
                "usemtl red\nf 1 2 3 4\nusemtl blue\nf 2 5 3\n");
  folder_.write("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  read("{mesh: {file: two.obj}}");
  const render::DrawnBody body = drawn_->bodies()[1];
  ASSERT_EQ(body.finish.size(), 2u);
  EXPECT_EQ(body.surface.material.size(), 3);
  EXPECT_EQ(body.surface.material(2), 1);
  EXPECT_EQ(body.surface.colour.rows(), body.surface.uv.rows());
}

// The velocity that is drawn is the rate of the position that is drawn.
TEST_F(DrawnColliders, MoveAsTheyAreDrawn) {
  read("{box: {size: [1, 2, 3]}, motion: [{time: 0}, {time: 2, translate: [1, 0, 0], rotate: [0, 90, 45]}]}");
  const double time = 0.7, step = 1e-3;
  const auto position = [&](double t) -> Eigen::MatrixX3f { return drawn_->surfaces(at(t))[1].position; };
  const Eigen::MatrixX3f rate = (position(time + step) - position(time - step)) / static_cast<float>(2.0 * step);
  EXPECT_LT((drawn_->surfaces(at(time))[1].velocity - rate).cwiseAbs().maxCoeff(), 2e-3f);
  EXPECT_GT(rate.cwiseAbs().maxCoeff(), 0.5f);
}

TEST_F(DrawnColliders, StayBehindACameraThatFollowsABody) {
  read("{sphere: {radius: 0.1}}", "render: {camera: {follow: sheet}}\n");
  sim::State state = at(0.0);
  state.position.col(0).array() += 3.0;
  const Eigen::RowVector3f way =
      drawn_->surfaces(state)[1].position.colwise().mean() - drawn_->surfaces(at(0.0))[1].position.colwise().mean();
  EXPECT_LT((way - Eigen::RowVector3f(-3.0f, 0.0f, 0.0f)).norm(), 1e-5f);
}

TEST_F(DrawnColliders, HaveSharpEdges) {
  read("{box: {size: [1, 1, 1]}}, {sphere: {radius: 1}}");
  EXPECT_EQ(drawn_->bodies()[1].surface.points(), 6 * 17 * 17);
  EXPECT_EQ(drawn_->bodies()[2].surface.points(), scene_->colliders[1].solid.mesh.vertices());
}

TEST_F(DrawnColliders, PlanesReachFarAroundTheBodies) {
  read("{plane: {point: [0, -1, 0], normal: [0, 2, 0]}}");
  const cli::DrawnScene& drawn = *drawn_;
  const Eigen::AlignedBox3d box = cli::box_of(drawn.surfaces(at(0.0))[1]);
  EXPECT_NEAR(box.min().y(), -1.0, 1e-6);
  EXPECT_NEAR(box.max().y(), -1.0, 1e-6);
  EXPECT_LT(box.min().x(), -5.0);
  EXPECT_GT(box.max().z(), 5.0);
  const render::DrawnBody body = drawn.bodies()[1];
  const Eigen::MatrixX3f position = drawn.surfaces(at(0.0))[1].position;
  const Eigen::RowVector3i corner = body.surface.triangle.row(0);
  const auto place = [&](int c) -> Eigen::RowVector3f { return position.row(body.surface.point(corner(c))); };
  EXPECT_GT((place(1) - place(0)).cross(place(2) - place(0)).y(), 0.0f);  // seen from above
  EXPECT_NEAR(body.surface.uv.col(0).maxCoeff() - body.surface.uv.col(0).minCoeff(), box.sizes().x(), 1e-4);
}

// The cloth is 1.4 m from corner to corner.
TEST_F(DrawnColliders, AreFramedAsFarAsTheyMatter) {
  const auto framed = [&](const std::string& collider) {
    read(collider);
    return drawn_->box(at(0.0));
  };
  const Eigen::AlignedBox3d alone = framed("{plane: {height: -1}}");
  EXPECT_EQ(alone.sizes().y(), 0.0);
  const Eigen::AlignedBox3d ball = framed("{sphere: {centre: [0, 0.5, 0], radius: 0.3}}");
  EXPECT_NEAR(ball.max().y(), 0.8, 1e-6);
  EXPECT_TRUE(framed("{sphere: {centre: [0, 20, 0], radius: 0.3}}").isApprox(alone));
  const Eigen::AlignedBox3d floor = framed("{box: {centre: [0, -1, 0], size: [50, 2, 50]}}");
  EXPECT_LT(floor.diagonal().norm(), 1.8 * alone.diagonal().norm());
  EXPECT_GT(floor.diagonal().norm(), alone.diagonal().norm());
}

}  // namespace
}  // namespace billow
