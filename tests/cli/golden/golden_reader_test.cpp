// Files of tests: what is read from them, and what is said of each mistake, and where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "cli/golden/golden_tests.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

using cli::RunPicture;
using testing::ElementsAre;

class GoldenReader : public testing::Test {
 protected:
  GoldenReader() {
    folder_.scene(test::base_scene);
    for (const char* mask : {"mask.png", "m.png"}) folder_.write(mask, "");
  }

  cli::GoldenTests read(const std::string& text) const { return cli::read_golden_tests(folder_.write("t.yaml", text)); }

  // A file with these tests, one a line.
  static std::string file_of(const std::string& tests) { return "billow_golden: 1\ntests:\n" + tests; }

  // What is wrong with it, without its folder.
  std::string error(const std::string& text) const {
    try {
      read(text);
      return "";
    } catch (const InputError& fault) {
      std::string message = fault.what();
      const std::string folder = folder_.path().string() + "/";
      for (std::size_t at = message.find(folder); at != message.npos; at = message.find(folder))
        message.erase(at, folder.size());
      return message;
    }
  }
  std::string test_error(const std::string& test) const { return error(file_of("  - {" + test + "}\n")); }

  test::SceneFolder folder_;
};

TEST_F(GoldenReader, ReadsTestsOfScenesFoldersAndCommands) {
  const cli::GoldenTests tests = read(
      "billow_golden: 1\nbaselines: seen\ntolerance: {channel: 2}\ntests:\n"
      "  - name: drape\n    scene: scene.yaml\n    set: {duration: 1, render.fps: 5}\n    frames: [1, 2-4:2, 5-]\n"
      "    views: [velocity]\n    pictures: [frames, strip, sheet]\n"
      "  - {name: other, folder: there, tolerance: {reason: noise, metrics: {flip: 0.02}, mask: mask.png}}\n"
      "  - {name: made, command: [render, '-o={output}/a.png'], timeout: 5}\n");
  EXPECT_EQ(tests.baselines, folder_.path() / "seen");
  ASSERT_EQ(tests.tests.size(), 3u);
  const auto& drape = std::get<cli::RenderedPictures>(tests.tests[0].pictures);
  EXPECT_EQ(tests.tests[0].name, "drape");
  EXPECT_EQ(drape.scene, folder_.path() / "scene.yaml");
  EXPECT_EQ(drape.changes.size(), 2u);
  EXPECT_EQ(drape.frames.size(), 3u);
  EXPECT_THAT(drape.views, ElementsAre(render::View::velocity));
  EXPECT_THAT(drape.kinds, ElementsAre(RunPicture::frames, RunPicture::strip, RunPicture::sheet));
  EXPECT_EQ(tests.tests[0].tolerance.what.threshold, 2);
  EXPECT_EQ(std::get<cli::FoundPictures>(tests.tests[1].pictures).folder, folder_.path() / "there");
  EXPECT_EQ(tests.tests[1].tolerance.reason, "noise");
  EXPECT_EQ(tests.tests[1].tolerance.mask, folder_.path() / "mask.png");
  EXPECT_TRUE(tests.tests[1].tolerance.what.flip);
  const auto& made = std::get<cli::MadePictures>(tests.tests[2].pictures);
  EXPECT_THAT(made.command, ElementsAre("render", "-o={output}/a.png"));
  EXPECT_EQ(made.timeout, 5);
}

TEST_F(GoldenReader, ComparesAllFramesUnlessToldOtherwise) {
  const cli::GoldenTests tests = read(file_of("  - {name: drape, scene: scene.yaml}\n"));
  EXPECT_EQ(tests.baselines, folder_.path() / "baselines");
  const auto& drape = std::get<cli::RenderedPictures>(tests.tests[0].pictures);
  EXPECT_TRUE(drape.frames.empty());
  EXPECT_TRUE(drape.views.empty());
  EXPECT_THAT(drape.kinds, ElementsAre(RunPicture::frames));
}

TEST_F(GoldenReader, AsksForAReasonWhereMoreIsLetThrough) {
  const auto tolerance = [&](const std::string& map) {
    return test_error("name: a, scene: scene.yaml, tolerance: {" + map + "}");
  };
  for (const char* stricter :
       {"channel: 2", "worst: 16", "pixels: 0", "pixels: 0.5%, channel: 3", "worst: 3, pixels: 1%"})
    EXPECT_EQ(tolerance(stricter), "") << stricter;
  for (const char* wider : {"channel: 4", "worst: 17", "pixels: 2%", "pixels: 5", "ignore_alpha: true", "mask: m.png",
                            "metrics: {rmse: 0}"}) {
    EXPECT_EQ(tolerance(wider),
              "t.yaml:3:45: this may let through what is usually a difference; say why with the key 'reason'")
        << wider;
    EXPECT_EQ(tolerance(std::string("reason: a lamp flickers, ") + wider), "") << wider;
  }
  EXPECT_EQ(tolerance("reason: ' '"), "t.yaml:3:54: the reason is empty; say why this picture needs another tolerance");
  EXPECT_EQ(error("billow_golden: 1\ntolerance: {reason: all shake, pixels: 50}\ntests:\n"
                  "  - {name: a, folder: x, tolerance: {pixels: 40}}\n"),
            "");
}

TEST_F(GoldenReader, LooksForMasksBeforeAnythingIsRendered) {
  EXPECT_THAT(test_error("name: a, scene: scene.yaml, tolerance: {reason: r, mask: no.png}"),
              testing::StartsWith("t.yaml:3:63: there is no mask "));
}

TEST_F(GoldenReader, SaysWhatIsWrongWhereAndWhatToDo) {
  EXPECT_EQ(error("tests: []\n"),
            "t.yaml:1:1: the file of tests needs the key 'billow_golden'; begin it with 'billow_golden: 1'");
  EXPECT_EQ(
      error("billow_golden: 2\ntests: []\n"),
      "t.yaml:1:16: billow_golden, the version of the format of tests, must be 1: this billow reads version 1 only");
  EXPECT_EQ(error("billow_golden: 1\ntest: []\n"),
            "t.yaml:2:1: unknown key 'test' in the file of tests; did you mean 'tests'?");
  EXPECT_EQ(error("billow_golden: 1\ntests: []\n"),
            "t.yaml:2:8: tests is empty; add at least one, like {name: drape, scene: drape.yaml}");
  EXPECT_EQ(error(file_of("  - drape\n")), "t.yaml:3:5: a test must be a map, like {name: drape, scene: drape.yaml}");
  EXPECT_EQ(test_error("name: a"),
            "t.yaml:3:5: a test needs one of the keys 'scene', 'folder' and 'command': where its pictures come from");
  EXPECT_EQ(test_error("name: a, sceen: scene.yaml"),
            "t.yaml:3:15: unknown key 'sceen' in a test; did you mean 'scene'?");
  EXPECT_EQ(test_error("name: a, scene: scene.yaml, folder: b"),
            "t.yaml:3:34: a test has one of 'scene', 'folder' and 'command', and this one has 'scene' too; make it two "
            "tests");
  EXPECT_EQ(test_error("name: a, scene: scene.yaml, frame: 3"),
            "t.yaml:3:34: unknown key 'frame' in a test of a scene; did you mean 'frames'?");
  EXPECT_EQ(test_error("name: a, folder: b, frames: 3"),
            "t.yaml:3:26: unknown key 'frames' in a test of a folder; its keys are: name, folder, tolerance");
  EXPECT_EQ(test_error("scene: scene.yaml"), "t.yaml:3:5: a test of a scene needs the key 'name'");
  EXPECT_EQ(test_error("name: a/b, folder: c"), "t.yaml:3:12: a test's name is up to 64 letters, digits, _ and -");
  EXPECT_EQ(test_error("name: a, scene: none.yaml"),
            "t.yaml:3:22: there is no scene file none.yaml; the path is relative to this file's folder");
  EXPECT_EQ(test_error("name: a, scene: scene.yaml, set: 3"),
            "t.yaml:3:39: set must be a map of scene keys, like {solver.method: rk4}");
  EXPECT_EQ(test_error("name: a, scene: scene.yaml, frames: 5-3"),
            "t.yaml:3:42: frames is '5-3', and should be like 10, 1-250:5 or [1, 25, 200-]");
  EXPECT_EQ(test_error("name: a, scene: scene.yaml, frames: [1, 0]"),
            "t.yaml:3:46: frames is '0', and should be like 10, 1-250:5 or [1, 25, 200-]");
  EXPECT_EQ(test_error("name: a, scene: scene.yaml, frames: []"),
            "t.yaml:3:42: frames is empty; leave the key out for all frames");
  EXPECT_EQ(test_error("name: a, scene: scene.yaml, views: [velocty]"),
            "t.yaml:3:42: unknown view 'velocty'; did you mean 'velocity'?");
  EXPECT_EQ(test_error("name: a, scene: scene.yaml, pictures: [strip, strip]"),
            "t.yaml:3:52: pictures has 'strip' twice");
  EXPECT_EQ(test_error("name: a, scene: scene.yaml, pictures: []"),
            "t.yaml:3:44: pictures is empty; name at least one, or leave the key out");
  EXPECT_EQ(test_error("name: a, scene: scene.yaml, tolerance: {chanel: 3}"),
            "t.yaml:3:46: unknown key 'chanel' in the tolerance; did you mean 'channel'?");
  EXPECT_EQ(test_error("name: a, command: [render]"),
            "t.yaml:3:24: no argument of the command has {output}, which stands for the folder that it writes its "
            "pictures to; add it, or test a 'folder'");
  EXPECT_EQ(test_error("name: a, command: 'render {output}'").substr(0, 46),
            "t.yaml:3:24: command must be a list, not \"rend");
  EXPECT_EQ(test_error("name: a, command: [render, '{output}'], timeout: 0"),
            "t.yaml:3:55: timeout is 0 s; it must be at least 1 and at most 86400 s");
  EXPECT_EQ(error(file_of("  - {name: a, folder: b}\n  - {name: A, folder: c}\n")),
            "t.yaml:4:12: a second test named 'A'; the first is at t.yaml:3:12");
}

}  // namespace
}  // namespace billow
