// Scene files that are right: what they mean, their effective text and their hash.
#include "cli/scene/scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <locale>
#include <numbers>

#include "base/error.h"
#include "cli/yaml/yaml_tree.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

using cli::read_scene;
using cli::Scene;
using test::base_scene;
using test::edited;
using test::SceneFolder;

constexpr const char* least_scene = "billow: 1\nbodies: [{cloth: {mesh: cloth.obj}}]\n";

// A scene that sets every key to something other than its default.
constexpr const char* full_scene = R"(billow: 1
duration: 3
gravity: [0.5, -1.62, 0]
bodies:
  - name: sail
    cloth:
      mesh: ./cloth.obj
      transform: {scale: 2, rotate: [90, 0, 0], translate: [1, 2, 3]}
      mass: 0.5
      mass_distribution: uniform
      model: choi_ko
      stiffness: {structural: 100, shear: 50, bend: 10, max_eigenvalue: 1e5}
      buckling_rigidity: 1e-7
      damping: {model: spring, coefficient: 0.1, friction: 0.001}
      velocity: [1, 2, 3]
      pins: [{corner: bottom_right}, {vertices: [3, 0]}, {group: edge}, {box: [[0.9, 1.9, 2.9], [1.1, 2.1, 3.1]]}]
    colour: [1, 0, 0.5]
solver:
  method: rk4
  step: 0.004
  safety: 0.5
  linear_solver: cholesky
  tolerance: 0.001
  max_iterations: 50
  filter:
    kernel: gaussian
    lambda: 0.7
    lambda_keys: [[0, 1], [1.5, 0.5]]
    form: conserving
    target: force
    neighbours: radius
    radius: 3
    distances: current
    passes: 2
render:
  size: [33, 17]
  fps: 12.5
  samples: 16
  views: [velocity, textured]
  camera: {eye: [0, 1, 3], look_at: [0, 0.5, 0], fov: 60}
  ground: -1.5
  velocity_colour: magnitude
  velocity_range: 4
  velocity_shading: 0
  legend: false
  background: {top: "#000000", bottom: "#FFFFFF"}
strip: {step: 0.02, order: mesh}
)";

std::vector<int> pins_of(const Scene& scene) { return std::get<cli::ClothSpec>(scene.bodies[0].kind).options.pinned; }

TEST(SceneReader, GivesEveryKeyItsMeaning) {
  const SceneFolder folder;
  const Scene scene = read_scene(folder.scene(full_scene));
  EXPECT_EQ(scene.duration, 3.0);
  EXPECT_EQ(scene.gravity, Eigen::Vector3d(0.5, -1.62, 0));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].name, "sail");
  EXPECT_EQ(scene.bodies[0].initial_velocity, Eigen::Vector3d(1, 2, 3));
  ASSERT_TRUE(scene.strip);
  EXPECT_EQ(scene.strip->step, 0.02);
  EXPECT_EQ(scene.strip->order, cli::StripOrder::mesh);
}

TEST(SceneReader, ReadsTheMaterial) {
  const SceneFolder folder;
  const cli::ClothSpec spec = std::get<cli::ClothSpec>(read_scene(folder.scene(full_scene)).bodies[0].kind);
  const sim::ClothOptions& cloth = spec.options;
  EXPECT_EQ(cloth.name, "sail");
  EXPECT_EQ(cloth.mass, 0.5);
  EXPECT_FALSE(cloth.mass_by_area);
  EXPECT_EQ(cloth.spring_model, sim::SpringModel::choi_ko);
  EXPECT_EQ(cloth.structural, 100.0);
  EXPECT_EQ(cloth.shear, 50.0);
  EXPECT_EQ(cloth.bend, 10.0);
  EXPECT_EQ(spec.max_eigenvalue, 1e5);
  EXPECT_EQ(cloth.buckling_rigidity, 1e-7);
  EXPECT_EQ(cloth.damping_model, sim::DampingModel::spring);
  EXPECT_EQ(cloth.damping, 0.1);
  EXPECT_EQ(cloth.friction, 0.001);
  EXPECT_EQ(cloth.pinned, (std::vector<int>{0, 1, 2, 3, 4, 5, 8}));
}

TEST(SceneReader, ReadsTheSolver) {
  const SceneFolder folder;
  const cli::SolverSpec solver = read_scene(folder.scene(full_scene)).solver;
  EXPECT_EQ(solver.method, sim::Method::rk4);
  EXPECT_EQ(solver.step_rule, cli::StepRule::fixed);
  EXPECT_EQ(solver.step, 0.004);
  EXPECT_EQ(solver.safety, 0.5);
  EXPECT_EQ(solver.integrator.linear_solver, sim::LinearSolver::cholesky);
  EXPECT_EQ(solver.integrator.tolerance, 0.001);
  EXPECT_EQ(solver.integrator.max_iterations, 50);
  ASSERT_TRUE(solver.filter);
  EXPECT_EQ(solver.filter->kernel, sim::FilterKernel::gaussian);
  EXPECT_EQ(solver.filter->lambda, 0.7);
  EXPECT_EQ(solver.filter->lambda_keys, (std::vector<std::pair<double, double>>{{0, 1}, {1.5, 0.5}}));
  EXPECT_EQ(solver.filter->form, sim::FilterForm::conserving);
  EXPECT_EQ(solver.filter->target, sim::FilterTarget::force);
  EXPECT_EQ(solver.filter->neighbours, sim::FilterNeighbours::radius);
  EXPECT_EQ(solver.filter->radius, 3.0);
  EXPECT_EQ(solver.filter->distances, sim::FilterDistances::current);
  EXPECT_EQ(solver.filter->passes, 2);
}

TEST(SceneReader, ReadsTheRendering) {
  const SceneFolder folder;
  const render::Settings settings = read_scene(folder.scene(full_scene)).render;
  EXPECT_EQ(settings.width, 33);
  EXPECT_EQ(settings.height, 17);
  EXPECT_EQ(settings.fps, 12.5);
  EXPECT_EQ(settings.samples, 16);
  EXPECT_EQ(settings.views, (std::vector{render::View::velocity, render::View::textured}));
  EXPECT_FALSE(settings.camera.fitted);
  EXPECT_EQ(settings.camera.eye, Eigen::Vector3d(0, 1, 3));
  EXPECT_EQ(settings.camera.look_at, Eigen::Vector3d(0, 0.5, 0));
  EXPECT_DOUBLE_EQ(settings.camera.vertical_fov, std::numbers::pi / 3.0);
  EXPECT_TRUE(settings.ground);
  EXPECT_EQ(settings.ground_height, -1.5);
  EXPECT_EQ(settings.velocity_colour, render::VelocityColour::magnitude);
  EXPECT_EQ(settings.velocity_range, 4.0);
  EXPECT_EQ(settings.velocity_shading, 0.0);
  EXPECT_FALSE(settings.legend);
  EXPECT_TRUE(settings.background.top.isZero());
  EXPECT_TRUE(settings.background.bottom.isOnes());
}

// The words of an enumeration stand in the order of its enumerators; this is where a swap of either would show.
TEST(SceneReader, MatchesWordsAndEnumerators) {
  const SceneFolder folder;
  const auto file = folder.scene(base_scene);
  const auto method = [&](const char* word) { return read_scene(file, {{"solver.method", word}}).solver.method; };
  EXPECT_EQ(method("forward_euler"), sim::Method::forward_euler);
  EXPECT_EQ(method("fb_euler"), sim::Method::fb_euler);
  EXPECT_EQ(method("verlet"), sim::Method::verlet);
  EXPECT_EQ(method("rk4"), sim::Method::rk4);
  EXPECT_EQ(method("backward_euler"), sim::Method::backward_euler);
  EXPECT_EQ(method("imex"), sim::Method::imex);
  const auto form = [&](const char* word) {
    return read_scene(file, {{"solver.filter.form", word}}).solver.filter->form;
  };
  EXPECT_EQ(form("plain"), sim::FilterForm::plain);
  EXPECT_EQ(form("symmetric"), sim::FilterForm::symmetric);
  const auto pinned = [&](const char* word) {
    return pins_of(read_scene(file, {{"bodies.0.cloth.pins", std::string("[{corner: ") + word + "}]"}}));
  };
  EXPECT_EQ(pinned("top_left"), std::vector{0});
  EXPECT_EQ(pinned("top_right"), std::vector{2});
  EXPECT_EQ(pinned("bottom_left"), std::vector{6});
  EXPECT_EQ(pinned("bottom_right"), std::vector{8});
  for (const int samples : {1, 2, 4, 8, 16})
    EXPECT_EQ(read_scene(file, {{"render.samples", std::to_string(samples)}}).render.samples, samples);
}

TEST(SceneReader, NeedsOnlyAMesh) {
  const SceneFolder folder;
  const Scene scene = read_scene(folder.scene(least_scene));
  EXPECT_EQ(scene.duration, 10.0);
  EXPECT_EQ(scene.bodies[0].name, "body_0");
  EXPECT_EQ(scene.solver.step_rule, cli::StepRule::automatic);
  EXPECT_FALSE(scene.solver.filter);
  EXPECT_FALSE(scene.strip);
  EXPECT_TRUE(scene.render.camera.fitted);
  EXPECT_TRUE(scene.bodies[0].texture_file.empty());
  EXPECT_TRUE(pins_of(scene).empty());
}

TEST(SceneReader, RefusesASceneWithoutBodies) {
  const SceneFolder folder;
  EXPECT_EQ(test::scene_error(folder.scene("billow: 1\nbodies: []\n")),
            "scene.yaml:2:9: bodies is empty: a scene needs at least one body");
  EXPECT_EQ(test::scene_error(folder.scene("billow: 1\n")), "scene.yaml:1:1: the scene needs the key 'bodies'");
  EXPECT_EQ(test::scene_error(folder.scene("- billow: 1\n")), "scene.yaml:1:1: the scene must be a map, not a list");
}

// Rotations are what the documentation says: degrees, fixed axes, x before y before z.
TEST(SceneReader, MovesTheMesh) {
  const SceneFolder folder;
  const auto corner = [&](const std::string& transform) -> Eigen::Vector3d {
    const Scene scene = read_scene(folder.scene(base_scene), {{"bodies.0.cloth.transform", transform}});
    return scene.bodies[0].mesh.position.row(8);  // (1, 0, 1) in the file
  };
  EXPECT_TRUE(corner("{}").isApprox(Eigen::Vector3d(1, 0, 1)));
  EXPECT_TRUE(corner("{rotate: [90, 0, 0]}").isApprox(Eigen::Vector3d(1, -1, 0)));
  EXPECT_TRUE(corner("{rotate: [90, 90, 0]}").isApprox(Eigen::Vector3d(0, -1, -1)));
  EXPECT_TRUE(corner("{rotate: [90, 0, 90]}").isApprox(Eigen::Vector3d(1, 1, 0)));
  EXPECT_TRUE(corner("{rotate: {axis: [0, 5, 0], angle: 180}}").isApprox(Eigen::Vector3d(-1, 0, -1)));
  EXPECT_TRUE(corner("{scale: 2, rotate: [90, 0, 0], translate: [1, 1, 1]}").isApprox(Eigen::Vector3d(3, -1, 1)));
}

TEST(SceneReader, ReadsColoursAsSrgb) {
  const SceneFolder folder;
  const auto colour = [&](const std::string& text) {
    return read_scene(folder.scene(base_scene), {{"bodies.0.colour", text}}).bodies[0].colour;
  };
  // 0.5 in sRGB is 0.214 of the light, #bc about half.
  EXPECT_NEAR(colour("[0.5, 0, 1]").x(), 0.21404f, 1e-5f);
  EXPECT_NEAR(colour("'#bcBC00'").y(), 0.5029f, 1e-4f);
  EXPECT_EQ(colour("'#ff0000'"), Eigen::Vector3f(1, 0, 0));
}

TEST(SceneReader, BuildsAllBodiesAsOneStructure) {
  const SceneFolder folder;
  const std::string two = edited(base_scene, "solver:\n", "  - cloth: {mesh: cloth.obj}\nsolver:\n");
  const sim::Structure structure = cli::build_structure(read_scene(folder.scene(two)));
  EXPECT_EQ(structure.particles(), 18);
  ASSERT_EQ(structure.body.size(), 2u);
  EXPECT_EQ(structure.body[1].name, "body_1");
  EXPECT_TRUE(structure.pinned(0));
}

TEST(EffectiveScene, ReadsBackToItself) {
  for (const std::string& yaml : {base_scene, std::string(full_scene), std::string(least_scene)}) {
    const SceneFolder folder;
    const Scene scene = read_scene(folder.scene(yaml));
    const Scene again = read_scene(folder.scene(scene.effective));
    EXPECT_EQ(again.effective, scene.effective);
    EXPECT_EQ(again.hash, scene.hash);
    EXPECT_EQ(again.bodies[0].mesh.position, scene.bodies[0].mesh.position);
    EXPECT_EQ(again.bodies[0].colour, scene.bodies[0].colour);
    EXPECT_EQ(pins_of(again), pins_of(scene));
    EXPECT_EQ(again.render.camera.vertical_fov, scene.render.camera.vertical_fov);
    EXPECT_EQ(again.render.background.top, scene.render.background.top);
  }
}

TEST(EffectiveScene, DoesNotDependOnTheOrderOfKeysOrTheirSpelling) {
  const SceneFolder folder;
  const std::string one =
      read_scene(folder.scene("billow: 1\nduration: 2\nbodies: [{cloth: {mesh: cloth.obj}}]\n")).effective;
  const std::string other = read_scene(folder.scene("bodies:\n- cloth:\n    mesh: 'cloth.obj'\n    mass: 0.20\n"
                                                    "duration: 2.0e0\nbillow: 1\n"))
                                .effective;
  EXPECT_EQ(one, other);
}

// A decimal comma and grouped digits, as in a German or French session.
struct CommaLocale : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(EffectiveScene, DoesNotDependOnTheLocale) {
  const SceneFolder folder;
  const auto file = folder.scene(full_scene);
  const Scene plain = read_scene(file);
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaLocale));
  const Scene comma = read_scene(file);
  const std::string error = test::scene_error(folder.scene(edited(base_scene, "mass: 0.2", "mass: -1234.5")));
  std::locale::global(before);
  EXPECT_EQ(comma.effective, plain.effective);
  EXPECT_EQ(comma.hash, plain.hash);
  EXPECT_EQ(error, "scene.yaml:8:13: mass is -1234.5 kg; it must be above 0 and at most 1000000 kg");
}

TEST(SceneHash, DoesNotDependOnTheFolder) {
  const SceneFolder here, there;
  EXPECT_EQ(read_scene(here.scene(base_scene)).hash, read_scene(there.scene(base_scene)).hash);
  EXPECT_EQ(read_scene(here.scene(base_scene)).hash.size(), 16u);
}

TEST(SceneHash, ChangesWithTheSceneAndWithEveryFile) {
  const SceneFolder folder;
  const std::string before = read_scene(folder.scene(base_scene)).hash;
  EXPECT_NE(read_scene(folder.scene(edited(base_scene, "mass: 0.2", "mass: 0.3"))).hash, before);
  EXPECT_EQ(read_scene(folder.scene("# only a comment\n" + base_scene)).hash, before);
  folder.write("cloth.obj", "# a comment\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 4 3 2\n");
  const std::string other_mesh = read_scene(folder.scene(base_scene)).hash;
  EXPECT_NE(other_mesh, before);
  folder.write("cloth.obj", "# A comment\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 4 3 2\n");
  EXPECT_NE(read_scene(folder.scene(base_scene)).hash, other_mesh);
}

}  // namespace
}  // namespace billow
