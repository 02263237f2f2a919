// The glTF that a run leaves, before the Khronos validator and in a browser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/browser.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class GlbOfARun : public testing::Test {
 protected:
  // A shipped scene's glTF, in FOLDER/`name`.
  fs::path render(const std::string& scene, const std::string& name, std::vector<std::string> more) {
    const fs::path output = folder_.path() / name;
    std::vector<std::string> arguments{"render",     std::string(BILLOW_SOURCE_DIR) + "/scenes/" + scene,
                                       "-o",         output,
                                       "--cache",    "glb",
                                       "--progress", "none",
                                       "-D",         "render.size=[64, 36]",
                                       "-D",         "render.views=[velocity]"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::ToolResult result = test::run_tool(arguments, folder_.path());
    EXPECT_EQ(result.status, 0) << result.errors;
    return output / "caches/scene.glb";
  }
  std::vector<std::string> drape(const std::string& duration) const {
    return {"-D", "duration=" + duration, "-D", "bodies.drape.cloth.mesh=../assets/meshes/cloth_20.obj"};
  }

  test::TemporaryFolder folder_;
};

TEST_F(GlbOfARun, HasNothingThatTheValidatorMinds) {
  const std::vector<std::string> files{render("drape.yaml", "drape", drape("0.4")),
                                       render("fish.yaml", "fish", {"-D", "duration=0.2"}),
                                       render("table.yaml", "table", {"-D", "duration=0.12"})};
  std::vector<std::string> arguments{std::string(BILLOW_SOURCE_DIR) + "/tests/tools/validate_glb.js",
                                     BILLOW_NODE_FOLDER};
  arguments.insert(arguments.end(), files.begin(), files.end());
  const test::ToolResult result = test::run_program("node", arguments, folder_.path());
  ASSERT_EQ(result.status, 0) << result.errors << "./billow test installs node and gltf-validator";
  const json reports = json::parse(result.output);
  ASSERT_EQ(reports.size(), files.size());
  for (const json& report : reports) {
    EXPECT_EQ(report["issues"]["numErrors"], 0) << report["issues"]["messages"].dump(1);
    EXPECT_EQ(report["issues"]["numWarnings"], 0) << report["issues"]["messages"].dump(1);
    EXPECT_EQ(report["animations"], 1);
  }
}

// Several materials, a texture inside, a hole, glass and colours of vertices, read back by our own reader too.
TEST_F(GlbOfARun, KeepsTheLooksOfMeshes) {
  folder_.write(
      "two.obj",
      "mtllib two.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 1 1\nv 1 1 0 1 1 1\nv 0 1 0 1 1 1\nv 2 0 0 1 1 1\nv 2 1 0 1 1 1\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl lace\nf 1/1 2/2 3/3 4/4\nusemtl glass\nf 2/1 5/2 6/3 3/4\n");
  folder_.write("two.mtl", "newmtl lace\nmap_Kd lace.png\nnewmtl glass\nKd 1 0.5 0\nd 0.25\n");
  fs::copy_file(fs::path(BILLOW_SOURCE_DIR) / "assets/textures/lace.png", folder_.path() / "lace.png");
  folder_.write("two.yaml",
                "billow: 1\nduration: 0.2\nbodies: [{name: two, cloth: {mesh: two.obj, pins: [{corner: top_left}]}}]\n"
                "render: {size: [64, 36], views: [velocity]}\n");
  const test::ToolResult run = test::run_tool({"render", "two.yaml", "--cache", "glb", "-o", "out"}, folder_.path());
  ASSERT_EQ(run.status, 0) << run.errors;
  const std::string file = (folder_.path() / "out/caches/scene.glb").string();
  const test::ToolResult result = test::run_program(
      "node", {std::string(BILLOW_SOURCE_DIR) + "/tests/tools/validate_glb.js", BILLOW_NODE_FOLDER, file},
      folder_.path());
  ASSERT_EQ(result.status, 0) << result.errors;
  const json report = json::parse(result.output)[0];
  EXPECT_EQ(report["issues"]["numErrors"], 0) << report["issues"]["messages"].dump(1);
  EXPECT_EQ(report["issues"]["numWarnings"], 0) << report["issues"]["messages"].dump(1);
  const json seen = json::parse(test::run_tool({"mesh", file, "--json"}, folder_.path()).output);
  EXPECT_EQ(seen["materials"], json::array({"two_1", "two_2"}));
  EXPECT_EQ(seen["vertices"], 6);
  EXPECT_EQ(seen["colours"], true);
}

TEST_F(GlbOfARun, IsTheSameForAnyNumberOfThreadsAndListed) {
  std::vector<std::string> arguments = drape("0.4");
  arguments.insert(arguments.end(), {"--threads", "1"});
  const fs::path one = render("drape.yaml", "one", arguments);
  arguments.back() = "4";
  const fs::path four = render("drape.yaml", "four", arguments);
  const std::string bytes = test::read_text(one);
  EXPECT_GT(bytes.size(), 10000u);
  EXPECT_TRUE(bytes == test::read_text(four));
  EXPECT_TRUE(test::read_text(one.string() + ".js") == test::read_text(four.string() + ".js"));
  const json record = json::parse(test::read_text(folder_.path() / "one/run.json"));
  EXPECT_EQ(record["caches"],
            json::array({{{"format", "glb"}, {"file", "caches/scene.glb"}, {"first_frame", 1}, {"frames", 10}}}));
}

TEST_F(GlbOfARun, TurnsOnItsPage) {
  const fs::path film = render("drape.yaml", "film", drape("0.6")).parent_path().parent_path();
  fs::copy_file(fs::path(BILLOW_SOURCE_DIR) / "tests/tools/model_visit.html", film / "model_visit.html");
  const test::Visit visit = test::visit(film, "model_visit.html", 120.0);
  const json& seen = visit.result;
  ASSERT_TRUE(seen.contains("ended")) << seen;
  EXPECT_GT(seen["drawn"], 0.02);   // share of the picture's pixels that something covers
  EXPECT_GT(seen["turned"], 0.01);  // shares that differ from the step before
  EXPECT_GT(seen["zoomed"], 0.01);
  EXPECT_GT(seen["panned"], 0.01);
  EXPECT_LT(seen["reset"], 0.001);  // from the beginning
  EXPECT_GT(seen["by_key"], 0.01);
  EXPECT_GT(seen["later"], 0.01);
  EXPECT_EQ(seen["player"], seen["frame"]);  // the model's slider moves the player
}

}  // namespace
}  // namespace billow
