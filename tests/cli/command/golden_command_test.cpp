// billow golden from outside: what it makes, what it says of it, what becomes a baseline.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "render/image/png.h"
#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;
using Json = nlohmann::json;

// Five frames, drawn without a survey.
const std::string small_scene =
    "billow: 1\nduration: 0.2\nbodies: [{cloth: {mesh: cloth.obj, mass: 0.1, pins: [{corner: top_left}]}}]\n"
    "solver: {step: 0.005}\n"
    "render: {size: [48, 32], samples: 1, ground: false, velocity_range: 2, legend: false,\n"
    "  camera: {eye: [0, 1, 3], look_at: [0, 0, 0]}}\n"
    "strip: {step: 0.02}\nspectrum: {step: 0.04, at: 0.1}\n";

class GoldenCommand : public testing::Test {
 protected:
  GoldenCommand() {
    unsetenv("CI");
    folder_.scene(small_scene);
    tests("  - {name: drape, scene: scene.yaml, frames: [1, 3]}\n");
  }
  ~GoldenCommand() override {
    if (!ci_.empty()) setenv("CI", ci_.c_str(), 1);
  }

  void tests(const std::string& text) const { folder_.write("t.yaml", "billow_golden: 1\ntests:\n" + text); }

  ToolResult golden(std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.begin(), {"golden", "t.yaml"});
    return test::run_tool(arguments, folder_.path());
  }
  ToolResult compare(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "compare");
    return test::run_tool(arguments, folder_.path());
  }
  Json record() const { return Json::parse(test::read_text(folder_.path() / "out/t/golden.json")); }
  // Of the pictures that were compared, by name.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    const Json all = record();
    for (const Json& image : all["images"]) names.push_back(image["name"]);
    return names;
  }
  std::string why(std::size_t row) const { return record()["images"].at(row)["why"]; }
  bool exists(const std::string& file) const { return fs::exists(folder_.path() / file); }

  // A picture that some other renderer has made.
  void other(const std::string& name, int grey) const {
    render::Image image(20, 10);
    std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::uint8_t>(grey));
    fs::create_directories((folder_.path() / name).parent_path());
    render::write_png(folder_.path() / name, image);
  }

  // Whether a process that was killed is soon gone, but for what of it waits to be asked for.
  static bool ends(const std::string& pid) {
    for (int k = 0; k < 1000; ++k) {
      const std::string state = test::read_text("/proc/" + pid + "/stat");
      if (state.empty() || state.find(") Z ") != state.npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  test::SceneFolder folder_;
  const std::string ci_ = std::getenv("CI") ? std::getenv("CI") : "";
};

TEST_F(GoldenCommand, FailsWithoutBaselinesAndLeavesThePicturesWhereAcceptFindsThem) {
  const ToolResult first = golden();
  EXPECT_EQ(first.status, 3) << first.errors;
  EXPECT_THAT(first.output, HasSubstr("DIFFERENT: new: it has no baseline yet; look at "
                                      "out/t/actual/drape/textured/frame_0001.png"));
  EXPECT_THAT(first.errors, HasSubstr("4 of 4 need a look: out/t/index.html"));
  EXPECT_THAT(first.errors, HasSubstr("billow golden t.yaml --update drape"));
  EXPECT_THAT(names(), ElementsAre("drape/textured/frame_0001.png", "drape/textured/frame_0003.png",
                                   "drape/velocity/frame_0001.png", "drape/velocity/frame_0003.png"));
  EXPECT_FALSE(exists("baselines"));
  EXPECT_TRUE(exists("out/t/index.html"));

  EXPECT_EQ(compare({"baselines", "out/t/actual", "--accept"}).status, 0);
  const ToolResult second = golden();
  EXPECT_EQ(second.status, 0) << second.output;
  EXPECT_THAT(second.output, HasSubstr("4 of 4 the same"));
  EXPECT_EQ(second.errors, "[1/1] drape: done in " + second.errors.substr(21));
}

TEST_F(GoldenCommand, UpdatesWhatItIsTold) {
  tests(
      "  - {name: drape, scene: scene.yaml, frames: 3}\n"
      "  - {name: other, scene: scene.yaml, frames: 1, views: [textured]}\n");
  EXPECT_EQ(golden({"--update", "other"}).status, 0);
  EXPECT_TRUE(exists("baselines/other/textured/frame_0001.png"));
  EXPECT_FALSE(exists("baselines/drape"));
  const ToolResult one = golden({"--update", "drape/velocity/*"});
  EXPECT_EQ(one.output.substr(one.output.rfind("accepted")), "accepted drape/velocity/frame_0003.png\n");
  EXPECT_FALSE(exists("baselines/drape/textured"));
  EXPECT_EQ(golden().status, 3);
  EXPECT_EQ(golden({"--update", "*"}).status, 0);
  EXPECT_EQ(golden().status, 0);
}

TEST_F(GoldenCommand, UpdatesNothingWhereCIIsSet) {
  setenv("CI", "true", 1);
  const ToolResult result = golden({"--update", "drape"});
  unsetenv("CI");
  EXPECT_EQ(result.status, 4);
  EXPECT_THAT(result.errors, HasSubstr("--update: CI is set in the environment"));
  EXPECT_FALSE(exists("baselines"));
  EXPECT_FALSE(exists("out"));
}

TEST_F(GoldenCommand, SaysWhatDiffers) {
  ASSERT_EQ(golden({"--update", "drape"}).status, 0);
  tests("  - {name: drape, scene: scene.yaml, frames: [1, 3], set: {bodies.0.colour: \"#ff0000\"}}\n");
  const ToolResult result = golden({"--junit", "results.xml"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(why(0), HasSubstr("px over 3/255"));
  EXPECT_THAT(result.output, HasSubstr("2 of 4 the same"));  // velocities have no colour of their own
  const std::string junit = test::read_text(folder_.path() / "results.xml");
  EXPECT_THAT(junit, HasSubstr("<testsuite name=\"billow golden t.yaml\" tests=\"4\" failures=\"2\" errors=\"0\">"));
  EXPECT_THAT(junit, HasSubstr("name=\"drape/velocity/frame_0001.png\"/>"));

  tests(
      "  - {name: drape, scene: scene.yaml, frames: [1, 3], set: {bodies.0.colour: \"#ff0000\"},\n"
      "     tolerance: {reason: it was repainted, worst: 255, pixels: 100%}}\n");
  EXPECT_EQ(golden().status, 0);
  folder_.write("baselines/drape/textured/frame_0003.tolerance.yaml", "reason: not here\nworst: 1\n");
  EXPECT_EQ(golden().status, 3);
}

TEST_F(GoldenCommand, GoesOnWhenASceneFails) {
  folder_.write("bad.yaml", "billow: 1\nbodies: [{cloth: {mesh: cloth.obj, mas: 3}}]\n");
  tests(
      "  - {name: bad, scene: bad.yaml}\n  - {name: drape, scene: scene.yaml, frames: 3, views: [velocity]}\n"
      "  - {name: late, scene: scene.yaml, frames: 6}\n"
      "  - {name: wild, scene: scene.yaml, set: {solver.watch: false, solver.step: 0.1}}\n"
      "  - {name: plain, scene: scene.yaml, set: {strip: none}, pictures: [strip]}\n");
  const ToolResult result = golden({"--update", "*", "--junit", "results.xml"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(names(), ElementsAre("bad", "drape/velocity/frame_0003.png", "late", "wild", "plain"));
  EXPECT_EQ(why(0), "no pictures: bad.yaml:2:36: unknown key 'mas' in cloth; did you mean 'mass'?");
  EXPECT_EQ(why(1), "accepted");
  EXPECT_THAT(why(2), HasSubstr("t.yaml:5:45: frames 6: the scene has frames 1 to 5"));
  EXPECT_THAT(why(3), HasSubstr("no pictures: "));
  EXPECT_THAT(why(4), HasSubstr("t.yaml:7:68: the scene makes no strip; give it a 'strip', like set: {strip: {}}"));
  EXPECT_THAT(test::read_text(folder_.path() / "results.xml"), HasSubstr("failures=\"1\" errors=\"4\""));
}

TEST_F(GoldenCommand, ComparesEveryPictureThatARunWrites) {
  tests(
      "  - {name: all, scene: scene.yaml, frames: 2, views: [textured, depth],\n"
      "     pictures: [frames, sheet, strip, velocity_image, spectrum]}\n"
      "  - {name: strip, scene: scene.yaml, pictures: [strip]}\n");
  ASSERT_EQ(golden({"--update", "*"}).status, 0);
  EXPECT_THAT(names(),
              UnorderedElementsAre("all/textured/frame_0002.png", "all/depth/frame_0002.png", "all/textured_sheet.png",
                                   "all/depth_sheet.png", "all/velocity_strip.png", "all/velocity_image.png",
                                   "all/velocity_spectrum.png", "strip/velocity_strip.png"));
  // Of the whole run, whatever frames are compared.
  const fs::path strips = folder_.path() / "baselines";
  EXPECT_EQ(render::read_png(strips / "all/velocity_strip.png").width, 10);
  EXPECT_EQ(test::read_text(strips / "all/velocity_strip.png"), test::read_text(strips / "strip/velocity_strip.png"));
  EXPECT_EQ(golden().status, 0);
}

TEST_F(GoldenCommand, ComparesNumbers) {
  tests("  - {name: numbers, scene: scene.yaml, frames: 2, views: [data]}\n");
  ASSERT_EQ(golden({"--update", "*"}).status, 0);
  EXPECT_THAT(names(), ElementsAre("numbers/data/frame_0002.exr"));
  EXPECT_EQ(golden().status, 0);
  tests("  - {name: numbers, scene: scene.yaml, frames: 2, views: [data], set: {gravity: [0, -20, 0]}}\n");
  EXPECT_EQ(golden().status, 3);
}

TEST_F(GoldenCommand, RunsThoseThatAreAskedFor) {
  tests("  - {name: one, folder: one}\n  - {name: two, folder: two}\n");
  for (const char* name : {"one/a.png", "one/b.png", "two/a.png"}) other(name, 50);
  EXPECT_EQ(golden({"--list"}).output, "one\ntwo\n");
  EXPECT_EQ(golden({"--list", "--only", "t*"}).output, "two\n");
  EXPECT_FALSE(exists("out"));
  golden({"--only", "two"});
  EXPECT_THAT(names(), ElementsAre("two/a.png"));
  golden({"--only", "one/b.png", "two"});
  EXPECT_THAT(names(), ElementsAre("one/b.png", "two/a.png"));
  EXPECT_THAT(golden({"--only", "onne"}).errors, HasSubstr("--only: there is no test 'onne'; did you mean 'one'?"));
  const ToolResult none = golden({"--only", "one/c.png"});
  EXPECT_EQ(none.status, 4);
  EXPECT_THAT(none.errors, HasSubstr("--only: no test has a picture 'one/c.png'"));
}

TEST_F(GoldenCommand, KeepsNoPicturesOfEarlierRuns) {
  golden();
  ASSERT_EQ(names().size(), 4u);
  tests("  - {name: drape, scene: scene.yaml, frames: 1, views: [velocity]}\n");
  golden({"--only", "drape"});
  EXPECT_THAT(names(), ElementsAre("drape/velocity/frame_0001.png"));
}

TEST_F(GoldenCommand, ComparesWhatOthersHaveMade) {
  tests("  - {name: other, folder: made, tolerance: {channel: 0}}\n");
  EXPECT_EQ(golden().status, 3);
  EXPECT_EQ(why(0), "there is no folder made; run what makes its pictures first");
  other("made/motion/0001.png", 50);
  ASSERT_EQ(golden({"--update", "other"}).status, 0);
  EXPECT_TRUE(exists("baselines/other/motion/0001.png"));
  EXPECT_EQ(golden().status, 0);
  other("made/motion/0001.png", 51);
  EXPECT_EQ(golden().status, 3);
  other("made/mask.png", 0);
  tests("  - {name: other, folder: made, tolerance: {reason: nothing counts, mask: made/mask.png, channel: 0}}\n");
  EXPECT_EQ(golden().status, 3);
  EXPECT_THAT(names(), ElementsAre("other/motion/0001.png"));
  EXPECT_THAT(why(0), HasSubstr("no pixel counts"));
  tests("  - {name: other, folder: made, tolerance: {channel: 0}}\n");
  fs::remove(folder_.path() / "made/mask.png");
  fs::remove(folder_.path() / "made/motion/0001.png");
  other("made/motion/0002.png", 51);
  EXPECT_EQ(golden().status, 3);
  EXPECT_THAT(why(0), HasSubstr("there is no such picture; if that is right, remove baselines/other/motion/0001.png"));
  EXPECT_THAT(why(1), HasSubstr("new: "));
}

TEST_F(GoldenCommand, RunsCommandsWhereTheUserAllowsIt) {
  other("source.png", 50);
  tests(
      "  - {name: good, command: [cp, source.png, '{output}/a $(touch ran).png']}\n"
      "  - {name: bad, command: [sh, -c, 'echo it broke >&2; exit 7', '{output}']}\n"
      "  - {name: slow, command: [sh, -c, 'sleep 50 & wait', '{output}'], timeout: 1}\n"
      "  - {name: unknown, command: [no-such-renderer, '{output}']}\n"
      "  - {name: idle, command: [true, '{output}']}\n");
  EXPECT_EQ(golden().status, 3);
  EXPECT_THAT(why(0), HasSubstr("no pictures: it is a command, and none is run without --allow-commands"));
  EXPECT_EQ(golden({"--allow-commands", "--untrusted"}).status, 2);
  EXPECT_EQ(golden({"--allow-commands", "--update", "*"}).status, 3);
  EXPECT_TRUE(exists("baselines/good/a $(touch ran).png"));
  EXPECT_FALSE(exists("ran"));
  EXPECT_EQ(why(1), "no pictures: exit status 7: it broke; its log is out/t/runs/bad/log.txt");
  EXPECT_EQ(why(2), "no pictures: its command took longer than 1 s; give it a longer 'timeout'");
  EXPECT_THAT(why(3), HasSubstr("cannot start no-such-renderer: No such file or directory; is it installed?"));
  EXPECT_EQ(why(4),
            "out/t/actual/idle is empty: the command wrote no picture to {output}; its log is out/t/runs/idle/log.txt");
}

TEST_F(GoldenCommand, EndsWithItsTestsAndWhatTheyStarted) {
  tests("  - {name: slow, command: [sh, -c, 'echo $$ > pid; sleep 50 & echo $! >> pid; wait', '{output}']}\n");
  const ToolResult result =
      test::run_tool({"golden", "t.yaml", "--allow-commands"}, folder_.path(), 0.5, folder_.path() / "pid");
  EXPECT_EQ(result.status, 130);
  EXPECT_THAT(result.errors, HasSubstr("stopped before pictures were compared"));
  EXPECT_EQ(record()["interrupted"], true);
  std::istringstream pids(test::read_text(folder_.path() / "pid"));
  int count = 0;
  for (std::string pid; pids >> pid; ++count) EXPECT_TRUE(ends(pid)) << pid;
  EXPECT_EQ(count, 2);
}

TEST_F(GoldenCommand, ReadsNothingOutsideForStrangers) {
  fs::create_directories(folder_.path() / "job/baselines/link");
  fs::create_directories(folder_.path() / "job/here");
  other("secret.png", 50);
  fs::create_symlink(folder_.path() / "secret.png", folder_.path() / "job/here/a.png");
  const auto run = [&](const std::string& test) {
    folder_.write("job/t.yaml", "billow_golden: 1\ntests:\n  - {name: link, " + test + "}\n");
    return test::run_tool({"golden", "job/t.yaml", "--untrusted"}, folder_.path());
  };
  for (const char* outside :
       {"folder: ..", "scene: ../scene.yaml", "folder: here, tolerance: {reason: r, mask: ../secret.png}"}) {
    const ToolResult result = run(outside);
    EXPECT_EQ(result.status, 4) << outside;
    EXPECT_THAT(result.errors, HasSubstr("outside, and with --untrusted")) << outside;
  }
  EXPECT_EQ(run("folder: here").status, 3);
  EXPECT_THAT(why(0), HasSubstr("is a link that leads out of its folder"));
  EXPECT_EQ(run("command: [touch, '{output}/a']").status, 3);
  EXPECT_THAT(why(0), HasSubstr("with --untrusted none is run"));
}

TEST_F(GoldenCommand, WritesIntoFoldersOfTestsAlone) {
  EXPECT_EQ(golden({"-o", "."}).status, 6);
  folder_.write("file", "");
  EXPECT_EQ(golden({"-o", "file"}).status, 6);
  fs::create_directories(folder_.path() / "out/t");
  EXPECT_EQ(golden().status, 3);
  fs::remove_all(folder_.path() / "out/t/actual");
  fs::create_directories(folder_.path() / "elsewhere/drape");
  folder_.write("elsewhere/drape/mine.png", "mine");
  fs::create_symlink("../../elsewhere", folder_.path() / "out/t/actual");
  golden({"--only", "drape"});
  EXPECT_TRUE(exists("elsewhere/drape/mine.png"));
}

TEST_F(GoldenCommand, AnswersInJson) {
  const ToolResult result = golden({"--json"});
  const Json json = Json::parse(result.output);
  EXPECT_EQ(json["same"], false);
  EXPECT_EQ(json["tests"], "t.yaml");
  EXPECT_EQ(json["baselines"], "baselines");
  EXPECT_EQ(json["images"].size(), 4u);
  EXPECT_EQ(json, record());
}

}  // namespace
}  // namespace billow
