// Colliders and contact in scenes: what is read, what is the default, what is refused.
#include <gtest/gtest.h>

#include "base/error.h"
#include "cli/scene/contact_text.h"
#include "cli/scene/simulation.h"
#include "sim/body/fish.h"
#include "sim/mesh/closed_surface.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

constexpr const char* block = R"(v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 2 3 4
f 3 1 4
)";

class SceneContact : public testing::Test {
 protected:
  SceneContact() { folder_.write("block.obj", block); }

  /// A scene of one cloth, `body` being what its body says besides, and `rest` what the scene does.
  std::string text(const std::string& body, const std::string& rest) const {
    return "billow: 1\nbodies: [{cloth: {mesh: cloth.obj}" + (body.empty() ? "" : ", " + body) + "}]\n" + rest + "\n";
  }
  cli::Scene read(const std::string& body, const std::string& rest = "") const {
    return cli::read_scene(folder_.scene(text(body, rest)));
  }
  std::string error(const std::string& body, const std::string& rest) const {
    return test::scene_error(folder_.scene(text(body, rest)));
  }
  /// The collider that `keys` describe.
  cli::ColliderSpec collider(const std::string& keys) const {
    return read("", "colliders: [{" + keys + "}]").colliders.at(0);
  }

  test::SceneFolder folder_;
};

TEST_F(SceneContact, IsNoneWhereNothingSaysAnythingOfIt) {
  for (const cli::Scene& scene : {read(""), read("contact: none"), read("", "render: {ground: -1}"),
                                  read("", "colliders: []"), read("", "render: {ground: {height: -1}}")}) {
    EXPECT_FALSE(scene.contact);
    EXPECT_FALSE(scene.bodies[0].contact);
  }
}

TEST_F(SceneContact, IsOnForAllBodiesOnceAnythingSaysSo) {
  for (const cli::Scene& scene : {read("contact: {}"), read("", "colliders: [{sphere: {radius: 1}}]"),
                                  read("", "render: {ground: {height: -1, collide: true}}")}) {
    ASSERT_TRUE(scene.contact);
    ASSERT_EQ(scene.contact->body.size(), 1u);
    const sim::BodyContact& body = scene.contact->body[0];
    EXPECT_TRUE(body.touches);
    EXPECT_TRUE(body.self);
    EXPECT_EQ(body.thickness, 0.002);  // a quarter of the edge is 0.125
    EXPECT_EQ(body.friction, 0.3);
    EXPECT_EQ(body.face.size(), 4u);
  }
}

TEST_F(SceneContact, OfABodyIsAsItSays) {
  const cli::Scene scene = read("contact: {self: false, thickness: 0.01, friction: 0.7}");
  const sim::BodyContact& body = scene.contact->body[0];
  EXPECT_FALSE(body.self);
  EXPECT_EQ(body.thickness, 0.01);
  EXPECT_EQ(body.friction, 0.7);
}

TEST_F(SceneContact, IsThinOnAFineMesh) {
  const std::string cloth = "cloth: {mesh: cloth.obj, transform: {scale: 0.01}}, contact: {}";
  const cli::Scene scene = cli::read_scene(folder_.scene("billow: 1\nbodies: [{" + cloth + "}]\n"));
  EXPECT_NEAR(scene.contact->body[0].thickness, 0.25 * 0.005, 1e-9);
}

TEST_F(SceneContact, IsTheFabricsWhereTheClothHasOne) {
  const auto contact = [&](const std::string& rest) {
    const std::string cloth = "cloth: {mesh: cloth.obj, fabric: denim}, contact: {" + rest + "}";
    return cli::read_scene(folder_.scene("billow: 1\nbodies: [{" + cloth + "}]\n")).contact->body[0];
  };
  EXPECT_EQ(contact("").thickness, cli::fabric("denim").thickness);
  EXPECT_EQ(contact("").friction, cli::fabric("denim").friction);
  EXPECT_EQ(contact("friction: 0.9, thickness: auto").friction, 0.9);
  EXPECT_EQ(contact("friction: 0.9, thickness: auto").thickness, 0.002);
}

TEST_F(SceneContact, LeavesOutTheBodiesThatWantNone) {
  const cli::Scene scene = cli::read_scene(folder_.scene(R"(billow: 1
bodies:
  - {cloth: {mesh: cloth.obj}, contact: none}
  - {soft: {mesh: block.obj}}
  - {fish: {}}
colliders: [{plane: {height: -1}}]
)"));
  ASSERT_TRUE(scene.contact);
  const std::vector<sim::BodyContact>& body = scene.contact->body;
  EXPECT_FALSE(body[0].touches);
  EXPECT_TRUE(body[1].touches && !body[1].self);
  EXPECT_EQ(body[1].face.size(), 4u);
  EXPECT_TRUE(body[2].touches && !body[2].self);
  EXPECT_EQ(body[2].face, sim::fish_faces());
  EXPECT_EQ(body[2].thickness, 0.002);
}

// Nothing to do, but something to draw.
TEST_F(SceneContact, IsNoneWhereNoBodyTouches) {
  const cli::Scene scene = read("contact: none", "colliders: [{sphere: {radius: 1}}]");
  EXPECT_FALSE(scene.contact);
  EXPECT_EQ(scene.colliders.size(), 1u);
}

TEST_F(SceneContact, HasTheCollidersInOrderAndTheGroundLast) {
  const cli::Scene scene = read("", R"(colliders:
  - {name: ball, sphere: {centre: [0, 1, 0], radius: 0.5}, thickness: 0.004, friction: 0.9}
  - plane: {point: [1, 0, 0], normal: [-2, 0, 0]}
render: {ground: {height: -0.5, collide: true, friction: 0.6, thickness: 0.003}})");
  const std::vector<sim::Collider>& collider = scene.contact->collider;
  ASSERT_EQ(collider.size(), 3u);
  EXPECT_EQ(scene.colliders.size(), 2u);
  EXPECT_EQ(collider[0].name, "ball");
  EXPECT_FALSE(collider[0].half_space);
  EXPECT_EQ(collider[0].thickness, 0.004);
  EXPECT_EQ(collider[0].friction, 0.9);
  EXPECT_EQ(collider[1].name, "collider_1");
  EXPECT_EQ(collider[1].half_space->normal, -Eigen::Vector3d::UnitX());
  EXPECT_EQ(collider[1].thickness, 0.001);
  EXPECT_EQ(collider[1].friction, 0.3);
  EXPECT_EQ(collider[2].name, "ground");
  EXPECT_EQ(collider[2].half_space->point.y(), -0.5);
  EXPECT_EQ(collider[2].half_space->normal, Eigen::Vector3d::UnitY());
  EXPECT_EQ(collider[2].friction, 0.6);
  EXPECT_EQ(collider[2].thickness, 0.003);
  EXPECT_TRUE(scene.render.ground);
  EXPECT_EQ(scene.render.ground_height, -0.5);
}

TEST_F(SceneContact, CollidersHaveTheirShapes) {
  const auto volume = [&](const std::string& keys) { return sim::enclosed_volume(collider(keys).solid.mesh); };
  const double pi = 3.14159265358979;
  EXPECT_NEAR(volume("sphere: {radius: 0.5}"), pi / 6.0, 0.003);
  EXPECT_NEAR(volume("capsule: {from: [0, 0, 0], to: [1, 0, 0], radius: 0.5}"), pi / 6.0 + pi / 4.0, 0.006);
  EXPECT_NEAR(volume("cylinder: {from: [0, 0, 0], to: [0, 2, 0], radius: 0.5}"), pi / 2.0, 0.006);
  EXPECT_NEAR(volume("box: {size: [1, 2, 0.5], rotate: [0, 45, 0]}"), 1.0, 1e-9);
  EXPECT_NEAR(volume("mesh: {file: block.obj, transform: {scale: 2}}"), 8.0 / 6.0, 1e-6);
  EXPECT_EQ(collider("plane: {height: 0.2}").solid.half_space->point, Eigen::Vector3d(0.0, 0.2, 0.0));
  EXPECT_EQ(collider("mesh: {file: cloth.obj}").solid.mesh.face.size(), 4u);  // open
}

// A quarter turn takes a point right of the pivot to behind it.
TEST_F(SceneContact, CollidersMoveByTheirKeys) {
  const std::string motion = ", motion: [{time: 1}, {time: 3, translate: [0, 1, 0], rotate: [0, 90, 0]}]";
  const auto end = [&](const std::string& shape, const Eigen::Vector3d& point) -> Eigen::Vector3d {
    return collider(shape + motion).solid.motion.at(5.0) * point;
  };
  const Eigen::Vector3d centre(1.0, 0.0, 0.0), beside(2.0, 0.0, 0.0), moved(1.0, 1.0, -1.0);
  EXPECT_TRUE(end("sphere: {centre: [1, 0, 0], radius: 0.1}", beside).isApprox(moved));
  EXPECT_TRUE(end("capsule: {from: [0, 0, 0], to: [2, 0, 0], radius: 0.1}", beside).isApprox(moved));
  EXPECT_TRUE(end("box: {centre: [1, 0, 0], size: [1, 1, 1]}", beside).isApprox(moved));
  EXPECT_TRUE(end("plane: {point: [1, 0, 0]}", beside).isApprox(moved));
  EXPECT_TRUE(end("sphere: {radius: 0.1}, pivot: [1, 0, 0]", beside).isApprox(moved));
  EXPECT_TRUE(end("mesh: {file: block.obj, transform: {translate: [0.5, 0, -0.5]}}", Eigen::Vector3d(2.0, 0.5, 0.0))
                  .isApprox(Eigen::Vector3d(1.0, 1.5, -1.0), 1e-6));
  EXPECT_FALSE(collider("sphere: {radius: 1}").solid.motion.moves());
}

TEST_F(SceneContact, ReadsBackFromTheEffectiveScene) {
  const cli::Scene scene = read("", R"(colliders:
  - {sphere: {radius: 0.5}, motion: [{time: 0}, {time: 1, rotate: [0, 90, 0]}], pivot: [0, 1, 0], colour: "#ff0000"}
  - {mesh: {file: block.obj, transform: {rotate: {axis: [0, 1, 0], angle: 30}}}}
  - {plane: {point: [0, -1, 0], normal: [0, 1, 0.5]}}
  - {plane: {height: -1}}
  - {box: {size: [1, 1, 2], rotate: [10, 20, 30]}}
  - {cylinder: {from: [0, 0, 0], to: [0, 1, 0], radius: 0.2}}
render: {ground: {height: -2, collide: true}})");
  const cli::Scene again = cli::read_scene(folder_.write("again.yaml", scene.effective));
  EXPECT_EQ(again.effective, scene.effective);
  EXPECT_EQ(again.hash, scene.hash);
  EXPECT_NE(scene.effective.find("thickness: auto"), std::string::npos);
}

TEST_F(SceneContact, ReadsBackWithoutContact) {
  for (const std::string rest : {"", "render: {ground: {height: -1}}", "render: {ground: {}}"}) {
    const cli::Scene scene = read("", rest);
    const cli::Scene again = cli::read_scene(folder_.write("again.yaml", scene.effective));
    EXPECT_EQ(again.effective, scene.effective);
    EXPECT_FALSE(again.contact);
  }
}

TEST_F(SceneContact, IsInTheScenesHash) {
  const auto hash = [&] { return read("", "colliders: [{mesh: {file: block.obj}}]").hash; };
  const std::string before = hash();
  folder_.write("block.obj", std::string("# the same\n") + block);
  EXPECT_NE(hash(), before);
}

TEST_F(SceneContact, IsSwitchedFromTheCommandLine) {
  const auto file = folder_.scene(text("", "colliders: [{name: ball, sphere: {radius: 1}}]"));
  EXPECT_FALSE(cli::read_scene(file, {{"bodies.0.contact", "none"}}).contact);
  EXPECT_FALSE(cli::read_scene(file, {{"colliders", "[]"}}).contact);
  EXPECT_EQ(cli::read_scene(file, {{"colliders.ball.friction", "2"}}).contact->collider[0].friction, 2.0);
}

TEST_F(SceneContact, IsSaidInWords) {
  const cli::Scene scene = read("",
                                "colliders: [{name: ball, sphere: {radius: 1}, motion: [{time: 0}, {time: 1, "
                                "translate: [1, 0, 0]}]}]\nrender: {ground: {height: 0, collide: true}}");
  const std::vector<std::string> lines = cli::contact_lines(scene);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "contact: body body_0, 4 faces, thickness 2 mm, friction 0.3, also with itself");
  EXPECT_EQ(lines[1].substr(0, 24), "contact: collider ball, ");
  EXPECT_EQ(lines[1].substr(lines[1].size() - 42), "faces, thickness 1 mm, friction 0.3, moves");
  EXPECT_EQ(lines[2], "contact: collider ground, a half-space, thickness 1 mm, friction 0.3, still");
  EXPECT_TRUE(cli::contact_lines(read("")).empty());
}

TEST_F(SceneContact, WarnsWhereTheMeshIsFinerThanItsThickness) {
  const std::vector<std::string> lines = cli::contact_lines(read("contact: {thickness: 0.6}"));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[1].find("warning: 12 of the 12 edges of 'body_0' are shorter than the thickness of its contact, the "
                          "shortest 500 mm: "),
            0u)
      << lines[1];
  EXPECT_EQ(cli::contact_lines(read("contact: {thickness: 0.6, self: false}")).size(), 1u);
}

TEST_F(SceneContact, IsRefusedAtTheMeshOfABodyThatStartsInsideSomething) {
  const cli::Scene scene = read("", "colliders: [{name: wall, box: {centre: [0, 0, 0], size: [0.3, 0.1, 4]}}]");
  try {
    const cli::Simulation simulation(scene);
    FAIL() << "nothing was said";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(":2:25: 'body_0' and 'wall' cross where the run starts, in "),
              std::string::npos)
        << error.what();
  }
}

struct Fault {
  std::string body, rest, message;
};

TEST_F(SceneContact, IsRefusedWithThePlace) {
  const Fault faults[] = {
      {"contact: yes", "", "2:46: contact must be none or a map, not 'yes'"},
      {"contact: {thickness: 0}", "", "2:58: thickness is 0 m; it must be above 0 and at most 1 m"},
      {"contact: {thickness: thin}", "", "2:58: thickness must be auto or a number, not 'thin'"},
      {"contact: {slef: true}", "", "2:47: unknown key 'slef' in contact; did you mean 'self'?"},
      {"", "colliders: {}", "3:12: colliders must be a list, not a map"},
      {"", "colliders: [{}]",
       "3:13: a collider needs a shape, one of the keys 'plane', 'sphere', 'capsule', 'cylinder', 'box', 'mesh'"},
      {"", "colliders: [{sphere: {radius: 1}, box: {size: [1, 1, 1]}}]",
       "3:40: a collider has one shape, and this one has 'sphere' and 'box'; make it two colliders"},
      {"", "colliders: [{ball: {radius: 1}}]", "3:14: unknown key 'ball' in collider"},
      {"", "colliders: [{sphere: {radius: 0}}]", "3:31: radius is 0 m; it must be above 0 and at most 100000 m"},
      {"", "colliders: [{sphere: {}}]", "3:22: sphere needs the key 'radius'"},
      {"", "colliders: [{box: {size: [1, 0, 1]}}]", "3:30: size[1] is 0 m; it must be above 0 and at most 100000 m"},
      {"", "colliders: [{capsule: {from: [0, 0, 0], radius: 1}}]", "3:23: capsule needs the key 'to'"},
      {"", "colliders: [{cylinder: {from: [0, 1, 0], to: [0, 1, 0], radius: 1}}]", "3:46: to is where from is"},
      {"", "colliders: [{plane: {normal: [0, 0, 0]}}]",
       "3:30: normal has no direction: its length is 0; [0, 1, 0] is a floor's"},
      {"", "colliders: [{plane: {height: 1, normal: [0, 1, 0]}}]",
       "3:41: a plane at a height is level and has no 'normal'; leave one of both out"},
      {"", "colliders: [{mesh: {}}]", "3:20: mesh needs the key 'file'"},
      {"", "colliders: [{mesh: {file: bowl.obj}}]", "3:27: there is no mesh file bowl.obj"},
      {"", "colliders: [{sphere: {radius: 1}, friction: -1}]",
       "3:45: friction is -1; it must be at least 0 and at most 100"},
      {"", "colliders: [{sphere: {radius: 1}, motion: [{time: 1}, {time: 1}]}]",
       "3:55: motion[1] is no later than the one before it; sort the keys by time"},
      {"", "colliders: [{name: body_0, sphere: {radius: 1}}]",
       "3:20: a second body or collider named 'body_0'; the first is at scene.yaml:2:10"},
      {"", "colliders: [{name: 7, sphere: {radius: 1}}]", "3:20: the name '7' will not do"},
      {"", "render: {ground: {collide: true}}", "3:18: ground needs the key 'height': it says where bodies land"},
      {"", "render: {ground: {heigth: 1}}", "3:19: unknown key 'heigth' in ground; did you mean 'height'?"},
      {"", "colliders: [{name: ground, plane: {}}]\nrender: {ground: {height: 0, collide: true}}",
       "4:18: a second body or collider named 'ground'; the first is at scene.yaml:3:20"},
  };
  for (const Fault& fault : faults) {
    const std::string message = error(fault.body, fault.rest);
    EXPECT_EQ(message.substr(0, 11 + fault.message.size()), "scene.yaml:" + fault.message) << message;
  }
}

}  // namespace
}  // namespace billow
