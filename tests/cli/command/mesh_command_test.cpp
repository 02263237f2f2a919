// billow mesh, and scenes far from the origin, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "render/image/compare.h"
#include "render/image/png.h"
#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

using nlohmann::json;
using test::run_tool;
using test::ToolResult;
using testing::HasSubstr;

const std::string corpus = BILLOW_SOURCE_DIR "/tests/corpus/files/";

TEST(MeshCommand, PrintsWhatItFinds) {
  const test::TemporaryFolder folder;
  folder.write("two.obj",
               "o left wing\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 9 9 9\nl 1 2\nf 1 2 3\nf 4 5 6\n"
               "f 5 6 4\nf 1 1 2\n");
  const ToolResult seen = run_tool({"mesh", "two.obj"}, folder.path());
  EXPECT_EQ(seen.status, 0) << seen.errors;
  for (const char* part :
       {"two.obj: 6 vertices, 3 faces (3 triangles, 0 quads)", "size       6 x 1 x 0 m, from (0, 0, 0) to (6, 1, 0)",
        "pieces     2: 3 vertices around (0.333333, 0.333333, 0)", "groups     left wing", "not used   lines",
        "vertices of no face, left out: 1", "faces that collapse to a line or a point, left out: 1",
        "faces that are there twice: 1, at (5.33333, 0.333333, 0)"})
    EXPECT_THAT(seen.output, HasSubstr(part));
}

TEST(MeshCommand, PrintsJson) {
  const test::TemporaryFolder folder;
  const json seen = json::parse(run_tool({"mesh", corpus + "more_of_vertices.ply", "--json"}, folder.path()).output);
  EXPECT_EQ(seen["vertices"], 9);
  EXPECT_EQ(seen["triangles"], 8);
  EXPECT_EQ(seen["edges"], 16);
  EXPECT_EQ(seen["borders"].size(), 1u);
  EXPECT_EQ(seen["pieces"].size(), 1u);
  EXPECT_NEAR(seen["area"].get<double>(), 4.0, 1e-12);
  EXPECT_EQ(seen["weights"], json::array({"alpha", "confidence"}));
  EXPECT_EQ(seen["colours"], true);
  EXPECT_EQ(seen["not_used"], json::array({"elements 'edge'"}));
}

TEST(MeshCommand, SaysWhatIsWrongAsScenesDo) {
  const test::TemporaryFolder folder;
  const ToolResult seen = run_tool({"mesh", "none.obj"}, folder.path());
  EXPECT_EQ(seen.status, 4);
  EXPECT_THAT(seen.errors, HasSubstr("there is no such file"));
}

// The same scene around the origin and a hundred kilometres away.
TEST(FarFromTheOrigin, LooksTheSame) {
  const test::SceneFolder folder;
  const auto scene = folder.scene(
      "billow: 1\nduration: 0.2\nbodies: [{cloth: {mesh: cloth.obj, pins: [{corner: top_left}]}}]\n"
      "colliders: [{sphere: {centre: [0.5, -0.3, 0.5], radius: 0.2}}]\n"
      "render: {size: [160, 120], fps: 5, views: [textured, velocity], ground: {height: -0.5}}\n");
  const auto far_scene = folder.write(
      "far.yaml",
      "billow: 1\nduration: 0.2\nbodies: [{cloth: {mesh: cloth.obj, pins: [{corner: top_left}], transform: {translate: "
      "[400000, 300000, -500000]}}}]\n"
      "colliders: [{sphere: {centre: [400000.5, 299999.7, -499999.5], radius: 0.2}}]\n"
      "render: {size: [160, 120], fps: 5, views: [textured, velocity], ground: {height: 299999.5}}\n");
  ASSERT_EQ(run_tool({"render", scene.string(), "-o", "near"}, folder.path()).status, 0);
  const ToolResult far = run_tool({"render", far_scene.string(), "-o", "far"}, folder.path());
  ASSERT_EQ(far.status, 0) << far.errors;
  for (const char* frame : {"textured/frame_0001.png", "velocity/frame_0001.png"}) {
    const render::Image a = render::read_png(folder.path() / "near" / frame),
                        b = render::read_png(folder.path() / "far" / frame);
    EXPECT_LE(render::compare(a, b).mean, 0.02) << frame;
    EXPECT_LE(render::compare(a, b).max, 3) << frame;
  }
}

}  // namespace
}  // namespace billow
