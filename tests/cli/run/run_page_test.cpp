// The page of a run in a real browser: it loads, moves and looks as it should.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/browser.h"
#include "tests/support/golden.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::IsEmpty;

// A cloth that falls for 0.44 s: eleven frames.
const std::string scene_without_strip = R"(billow: 1
duration: 0.44
bodies:
  - name: drape
    cloth:
      mesh: cloth.obj
      transform: {scale: 0.0909}
      mass: 0.05
      stiffness: {max_eigenvalue: 100000}
      pins: [{corner: top_left}, {corner: top_right}]
    colour: "#2f7f86"
solver: {method: fb_euler}
render: {size: [320, 200], fps: 25, samples: 4}
)";
const std::string scene = scene_without_strip + "strip: {step: 0.02}\n";

class RunPageInBrowser : public testing::Test {
 protected:
  // The film of a scene whose name is no harmless text, and the pages that visit it.
  void render(const std::string& text, const std::vector<std::string>& more = {}, int status = 0) {
    folder_.write("cloth.obj", test::mesh_file("obj", test::quad_grid(12, 12)));
    folder_.write("a <b> & \"c\".yaml", text);
    std::vector<std::string> arguments{"render", "a <b> & \"c\".yaml", "-o", "film", "--progress", "none"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::ToolResult result = test::run_tool(arguments, folder_.path());
    ASSERT_EQ(result.status, status) << result.errors;
    for (const char* page : {"run_page_visit.html", "run_page_look.html"})
      fs::copy_file(fs::path(BILLOW_SOURCE_DIR) / "tests/cli/run" / page, film() / page,
                    fs::copy_options::overwrite_existing);
  }

  fs::path film() const { return folder_.path() / "film"; }
  json record() const { return json::parse(test::read_text(film() / "run.json")); }

  test::TemporaryFolder folder_;
};

json sources(const std::string& number) {
  return {"textured/frame_" + number + ".png", "velocity/frame_" + number + ".png"};
}

// The read-outs at the cursor are the record's numbers, as near as a plot's height and their decimals allow.
void expect_values(const json& values, const json& frame) {
  std::vector<double> wanted{frame["kinetic_energy"], frame["potential_energy"]};
  wanted.push_back(wanted[0] + wanted[1]);
  for (const char* momentum : {"linear_momentum", "angular_momentum"})
    for (const double component : frame[momentum]) wanted.push_back(component);
  for (const char* stretch : {"largest_stretch", "mean_stretch"}) wanted.push_back(frame[stretch]);
  ASSERT_EQ(values.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_NEAR(values[k], wanted[k], 0.002) << k;
}

TEST_F(RunPageInBrowser, MovesEverythingTogether) {
  render(scene);
  const test::Visit visit = test::visit(film(), "run_page_visit.html");
  EXPECT_THAT(visit.console, IsEmpty());
  const json& seen = visit.result;
  ASSERT_TRUE(seen.contains("played")) << seen;

  EXPECT_TRUE(seen["start"]["loaded"]);
  EXPECT_EQ(seen["scrubbed"]["frame"], 4);
  EXPECT_EQ(seen["scrubbed"]["sources"], sources("0004"));
  EXPECT_TRUE(seen["scrubbed"]["loaded"]);
  EXPECT_EQ(seen["scrubbed"]["clock"], "0.12 s, frame 4 of 11");
  EXPECT_NEAR(seen["scrubbed"]["cursor"], 0.12 / 0.44, 0.002);
  expect_values(seen["scrubbed"]["values"], record()["frames"][3]);

  EXPECT_EQ(seen["clicked"]["sources"], sources("0007"));  // half of 0.44 s is nearest to 0.24 s
  EXPECT_NEAR(seen["clicked"]["cursor"], 0.24 / 0.44, 0.002);
  expect_values(seen["clicked"]["values"], record()["frames"][6]);
  EXPECT_EQ(seen["dragged"]["frame"], 4);
  EXPECT_EQ(seen["released"]["frame"], 4);
  EXPECT_LT(seen["misaligned"], 0.6);  // pixels, strip against plots

  EXPECT_EQ(seen["stepped"]["frame"], 5);
  EXPECT_EQ(seen["leapt"]["frame"], 1);
  EXPECT_EQ(seen["playing"], "Pause");
  EXPECT_EQ(seen["played"]["frame"], 11);
  EXPECT_EQ(seen["played"]["button"], "Play");
  EXPECT_THAT(seen["requests"], IsEmpty());  // over a network; files are not counted
  EXPECT_EQ(seen["overflow"], 0);
}

TEST_F(RunPageInBrowser, ShowsWhatADivergedRunOfOneViewLeft) {
  render(scene_without_strip, {"-D", "solver.step=0.01", "-D", "render.views=[velocity]"}, 5);
  const test::Visit visit = test::visit(film(), "run_page_visit.html");
  EXPECT_THAT(visit.console, IsEmpty());
  ASSERT_TRUE(visit.result.contains("played")) << visit.result;
  EXPECT_EQ(visit.result["played"]["frame"], record()["frames"].back()["frame"]);
  EXPECT_TRUE(visit.result["played"]["loaded"]);
  EXPECT_THAT(test::read_text(film() / "index.html"),
              testing::HasSubstr("<p class=\"note bad\">This run did not finish: the simulation diverged"));
}

// A part of a run counts its frames within the whole, and one frame alone shows its values without a curve.
TEST_F(RunPageInBrowser, ShowsAPartOfARun) {
  render(scene, {"--frames", "4,6-7"});
  const test::Visit part = test::visit(film(), "run_page_visit.html");
  EXPECT_THAT(part.console, IsEmpty());
  EXPECT_EQ(part.result["scrubbed"]["clock"], "0.12 s, frame 4 of 11");
  expect_values(part.result["scrubbed"]["values"], record()["frames"][0]);
  EXPECT_EQ(part.result["played"]["frame"], 7);
  EXPECT_THAT(test::read_text(film() / "index.html"), testing::HasSubstr("frames 4, 6–7 of 11."));

  render(scene, {"--frames", "4", "--overwrite"});
  const test::Visit single = test::visit(film(), "run_page_visit.html");
  EXPECT_THAT(single.console, IsEmpty());
  EXPECT_EQ(single.result["start"]["clock"], "0.12 s, frame 4 of 11");
  EXPECT_EQ(single.result["start"]["cursor"], nullptr);
  expect_values(single.result["start"]["values"], record()["frames"][0]);
}

// What a run that failed had drawn is to be seen all the same.
TEST_F(RunPageInBrowser, ShowsWhatAFailedRunLeft) {
  folder_.write("film/velocity/frame_0005.png/in the way", "");
  folder_.write("film/run.json", "");
  render(scene, {"--overwrite", "--threads", "1"}, 6);
  const test::Visit visit = test::visit(film(), "run_page_visit.html");
  EXPECT_THAT(visit.console, IsEmpty());
  EXPECT_TRUE(visit.result["start"]["loaded"]) << visit.result;
  EXPECT_EQ(visit.result["played"]["clock"], "0.12 s, frame 4 of 11");
  EXPECT_THAT(test::read_text(film() / "index.html"), testing::HasSubstr("<p class=\"note bad\">This run failed: "));
}

// Finding no fault proves something only if faults are found.
TEST_F(RunPageInBrowser, SeesAMissingFrameAndAnError) {
  render(scene, {"--frames", "3-4"});
  fs::remove(film() / "velocity/frame_0004.png");
  const test::Visit visit = test::visit(film(), "run_page_visit.html");
  EXPECT_EQ(visit.result["scrubbed"]["loaded"], false) << visit.result;
  folder_.write("wrong.html", "<script>no_such_function()</script>");
  EXPECT_EQ(test::visit(folder_.path(), "wrong.html", 0.1).console.size(), 1u);
}

render::Image halved(const render::Image& image) {
  render::Image half(image.width / 2, image.height / 2, 3);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const auto at = [&](int dx, int dy) { return image.row(2 * y + dy)[image.channels * (2 * x + dx) + c]; };
        half.row(y)[3 * x + c] = static_cast<std::uint8_t>((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1) + 2) / 4);
      }
  return half;
}

// Browsers change how they draw letters from one release to the next, and little else: so the letters are made
// invisible, keeping their room, and edges are softened to half the size. What remains is the layout, the pictures, the
// strip, the cursor and the curves; the words are compared above. The picture ends above the facts, some of which
// differ between machines.
TEST_F(RunPageInBrowser, LooksAsItLookedBefore) {
  render(scene);
  const test::Screenshot shot = test::screenshot(film(), "run_page_look.html", 1000, 1060);
  EXPECT_THAT(shot.console, IsEmpty());
  ASSERT_EQ(shot.image.width, 1000);
  EXPECT_GOLDEN(halved(shot.image), "run_page");
}

}  // namespace
}  // namespace billow
