// Scenes of kinds that used to diverge under `step: auto`: each runs to its end, and its energy does nothing that what
// drives it does not explain.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

using testing::HasSubstr;
using testing::Not;

/// One body over a grid of a square metre, `side` particles wide.
struct Scene {
  int side = 8;
  double duration = 3.0;
  std::string gravity = "[0, -9.81, 0]";
  std::string cloth = {};  // more keys of it, on one line
  std::string solver = {};

  std::string text() const {
    return fmt::format(
        "billow: 1\nduration: {}\ngravity: {}\nbodies:\n  - name: sheet\n    cloth: {{mesh: sheet.obj, transform: "
        "{{scale: "
        "{}}}, mass: 0.2, {}}}\nsolver: {}\nrender: {{size: [16, 16], samples: 1, fps: 25, views: [velocity]}}\n",
        duration, gravity, 1.0 / (side - 1), cloth, solver);
  }
};

const std::string soft = "stiffness: {structural: 115, shear: 80, bend: 35}";
const std::string stiff = "stiffness: {structural: 115, shear: 80, bend: 35, max_eigenvalue: 100000}";

/// A run of a scene and its record.
struct Film {
  explicit Film(const Scene& scene) : Film(scene.text(), scene.side) {}
  Film(const std::string& text, int side) {
    folder.write("sheet.obj", test::mesh_file("obj", test::quad_grid(side, side)));
    folder.write("scene.yaml", text);
    result = test::run_tool({"render", "scene.yaml", "-o", "film", "--progress", "plain"}, folder.path());
    const auto file = folder.path() / "film" / "run.json";
    if (std::filesystem::exists(file)) record = nlohmann::json::parse(test::read_text(file));
    for (const auto& frame : record.value("frames", nlohmann::json::array()))
      energy.push_back(frame["kinetic_energy"].get<double>() + frame["potential_energy"].get<double>());
  }
  double climb() const {
    double lowest = HUGE_VAL, most = 0.0;
    for (const double e : energy) lowest = std::min(lowest, e), most = std::max(most, e - lowest);
    return most;
  }
  double step() const { return record["solver"]["step"]; }
  const nlohmann::json& incidents() const { return record["solver"]["watch"]["incidents"]; }

  test::TemporaryFolder folder;
  test::ToolResult result;
  nlohmann::json record = nlohmann::json::object();
  std::vector<double> energy;  // [J] of every frame
};

TEST(WatchedScene, KeepsAFishOfAllDefaultsInItsWater) {
  const Film film("billow: 1\nbodies:\n  - fish: {}\nrender: {size: [16, 16], samples: 1, views: [velocity]}\n", 2);
  EXPECT_EQ(film.result.status, 0) << film.result.errors;
  EXPECT_EQ(film.energy.size(), 250U);
  EXPECT_LT(film.climb(), 20.0);
  EXPECT_TRUE(film.incidents().empty());
  EXPECT_LT(film.step(), 0.0225);  // what one side of the tail allows while it pushes
}

TEST(WatchedScene, CountsLambdaAtItsWeakest) {
  Scene scene{.side = 12, .duration = 5.0, .cloth = stiff + ", pins: [{corner: top_left}, {corner: top_right}]"};
  scene.solver = "{filter: {lambda: 1, form: conserving, target: force, lambda_keys: [[0, 0.3], [2, 0.3], [2.1, 20]]}}";
  const Film film(scene);
  EXPECT_EQ(film.result.status, 0) << film.result.errors;
  EXPECT_LT(*std::max_element(film.energy.begin(), film.energy.end()), 0.02);
  // After 2.1 s nothing is left of the filter, so the step is that of none.
  scene.solver = "{}";
  EXPECT_NEAR(film.step(), Film(scene).step(), 2e-3 * film.step());
}

TEST(WatchedScene, SeesThatAFilterTurnsMotionsAroundUnderBackwardEuler) {
  Scene scene{.side = 8, .duration = 4.0, .cloth = soft + ", pins: [{corner: top_left}, {corner: top_right}]"};
  scene.solver = "{method: backward_euler, filter: {lambda: 1, kernel: gaussian}}";
  const Film film(scene);
  EXPECT_EQ(film.result.status, 0) << film.result.errors;
  EXPECT_LT(film.step(), 1e-3);
  EXPECT_LT(film.climb(), 0.01);
}

TEST(WatchedScene, KeepsTheEnergyOfAClothThrownFast) {
  Scene scene{.cloth = soft + ", pins: [{vertices: [0]}], velocity: [20, 5, 30]"};
  scene.solver = "{}";
  const Film film(scene);
  EXPECT_EQ(film.result.status, 0) << film.result.errors;
  const double thrown = 0.5 * 0.2 * (400.0 + 25.0 + 900.0);
  EXPECT_LT(film.climb(), 0.04 * thrown);
  ASSERT_FALSE(film.incidents().empty());
  EXPECT_THAT(film.result.errors, HasSubstr("the energy climbed beyond the work put in by t = "));
  EXPECT_THAT(test::read_text(film.folder.path() / "film" / "index.html"),
              HasSubstr("the energy climbed beyond the work"));
  EXPECT_EQ(film.incidents()[0]["kind"], "energy");
  EXPECT_LT(film.incidents()[0]["smallest_step"], film.step());
  // Given, the step stays, and what happens is said.
  scene.solver = fmt::format("{{step: {}}}", film.step());
  const Film given(scene);
  EXPECT_TRUE(given.result.status == 5 || given.climb() > 0.02 * thrown);
  EXPECT_EQ(given.record["solver"]["watch"]["changes_step"], false);
  scene.solver = fmt::format("{{step: {}, watch: true}}", film.step());
  EXPECT_EQ(Film(scene).energy, film.energy);
}

TEST(WatchedScene, HoldsForwardEulerWhoseDampingActsAlongSpringsOnly) {
  Scene scene{.duration = 5.0,
              .gravity = "[0, -60, 0]",
              .cloth = soft + ", damping: {coefficient: 0.3}, pins: [{vertices: [0]}]"};
  scene.solver = "{method: forward_euler}";
  const Film film(scene);
  EXPECT_EQ(film.result.status, 0) << film.result.errors;
  EXPECT_THAT(film.result.errors, HasSubstr("certified at rest only"));
  const double weight_times_size = 0.2 * 60.0 * std::sqrt(2.0);
  EXPECT_LT(film.climb(), 0.06 * weight_times_size);
}

// 2 m / c of the lightest particle, a corner of a quarter of a cell.
TEST(WatchedScene, RunsWithHeavyFriction) {
  Scene scene{.duration = 0.5, .cloth = soft + ", damping: {friction: 10}, pins: [{vertices: [0]}]"};
  scene.solver = "{}";
  const Film film(scene);
  EXPECT_EQ(film.result.status, 0) << film.result.errors;
  const double lightest = 0.2 / 49.0 / 4.0;
  EXPECT_NEAR(film.step(), 0.9 * 2.0 * lightest / 10.0, 0.02 * film.step());
  EXPECT_LE(film.climb(), 1e-9);
}

TEST(WatchedScene, KeepsBackwardEulerFromGainingByItsOwnSolves) {
  Scene scene{.duration = 4.0, .cloth = "stiffness: {structural: 1e8, shear: 1e8, bend: 1e8}, pins: [{vertices: [0]}]"};
  scene.solver = "{method: backward_euler}";
  const Film film(scene);
  EXPECT_EQ(film.result.status, 0) << film.result.errors;
  EXPECT_LT(film.climb(), 0.1);
}

TEST(WatchedScene, SaysWhyAClothThatIsTooSoftEndsWithFive) {
  Scene scene{.duration = 40.0,
              .cloth = "stiffness: {structural: 1e-5, shear: 0, bend: 0}, pins: [{corner: top_left}]"};
  scene.solver = "{}";
  const Film film(scene);
  EXPECT_EQ(film.result.status, 5);
  EXPECT_THAT(film.result.errors, HasSubstr("the springs are too soft for what pulls at them"));
}

TEST(WatchedScene, NamesThePlaceThatSetsTheStep) {
  // A sliver of a quad at a corner, as scans have them: its own corners weigh next to nothing.
  sim::Mesh mesh = test::quad_grid(9, 9);
  mesh.position.conservativeResize(84, 3);
  mesh.position.bottomRows<3>() << -0.01, 0.0, 0.0, -0.01, 0.0, -0.01, 0.0, 0.0, -0.01;
  mesh.face.push_back({0, 83, 82, 81});
  mesh.uv.push_back(mesh.uv.back());
  test::TemporaryFolder folder;
  folder.write("sheet.obj", test::mesh_file("obj", mesh));
  folder.write("scene.yaml", "billow: 1\nbodies:\n  - name: drape\n    cloth: {mesh: sheet.obj}\n");
  const test::ToolResult result = test::run_tool({"check", "scene.yaml"}, folder.path());
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, testing::ContainsRegex("edge [0-9]+-[0-9]+ of 'drape', [0-9.]+ mm long, sets the step: "
                                                    "without its neighbourhood it would be [0-9.]+ times longer"));
}

TEST(WatchedScene, NamesNoPlaceOnAnEvenCloth) {
  const Film film(Scene{.duration = 0.04, .cloth = soft, .solver = "{}"});
  EXPECT_TRUE(film.record["solver"]["set_by"].is_null());
  EXPECT_THAT(film.result.errors, Not(HasSubstr("sets the step")));
}

}  // namespace
}  // namespace billow
