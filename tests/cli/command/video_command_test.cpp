// billow video and billow sheet from outside: what other programs read of the films, and what is refused.
#include <fmt/format.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "render/image/compare.h"
#include "render/image/png.h"
#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using test::run_program;
using test::run_tool;
using test::ToolResult;

constexpr long frames = 6;

// Six frames of two views, of odd width and height.
class OfARun : public testing::Test {
 protected:
  OfARun() {
    folder_.scene(test::edited(test::edited(test::edited(test::base_scene, "size: [64, 48]", "size: [65, 47]"),
                                            "views: [textured]", "views: [textured, velocity]"),
                               "duration: 2", "duration: 0.24"));
    const ToolResult result = run({"render", "scene.yaml", "-o", "run", "--progress", "none"});
    EXPECT_EQ(result.status, 0) << result.errors;
  }

  ToolResult run(const std::vector<std::string>& arguments) { return run_tool(arguments, folder_.path()); }
  fs::path path(const std::string& file) const { return folder_.path() / file; }

  Json stream_of(const std::string& file) {
    const ToolResult result = run_program(
        "ffprobe", {"-v", "error", "-count_frames", "-select_streams", "v", "-show_streams", "-of", "json", file},
        folder_.path());
    EXPECT_EQ(result.status, 0) << result.errors;
    return Json::parse(result.output).at("streams").at(0);
  }

  // Frame `number`, from 0, of a film, cut to the size of the run's frames.
  render::Image frame_in(const std::string& film, int number) {
    const ToolResult result = run_program(
        "ffmpeg",
        {"-v", "error", "-y", "-i", film, "-vf", fmt::format("select=eq(n\\,{}),crop=65:47:0:0:exact=1", number),
         "-frames:v", "1", "-pix_fmt", "rgb24", "read.png"},
        folder_.path());
    EXPECT_EQ(result.status, 0) << result.errors;
    return render::read_png(path("read.png"));
  }

  double difference(const std::string& film, int number) {
    const render::Image drawn = render::read_png(path(fmt::format("run/textured/frame_{:04}.png", number + 1)));
    return render::compare(frame_in(film, number), drawn).rmse;
  }

  test::SceneFolder folder_;
};

using Video = OfARun;
using Sheet = OfARun;

// Its record and page are text all the same, and films are made of its frames.
TEST_F(OfARun, MayBeInAFolderOfAnyName) {
  const std::string name = "a\n'b' %d : \xff";
  fs::rename(path("run"), path(name));
  for (const std::string& film : {name + "/film.mp4", name + "/film.gif"}) {
    const ToolResult result = run({"video", name, "-o", film, "--progress", "none"});
    EXPECT_EQ(result.status, 0) << result.errors;
    EXPECT_TRUE(fs::is_regular_file(path(film)));
  }
  fs::remove_all(path(name));
  const ToolResult result = run({"render", "scene.yaml", "-o", name, "--progress", "none"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const std::string command = Json::parse(test::read_text(path(name) / "run.json"))["command"];
  EXPECT_NE(command.find("%d : \uFFFD"), std::string::npos) << command;
}

TEST_F(Video, OtherProgramsReadEveryFormat) {
  struct Case {
    std::string extension, codec;
    int width, height;
    double tolerance;  // of the root mean square, in 255
  };
  for (const Case& c : {Case{"mp4", "h264", 66, 48, 4.0}, Case{"webm", "vp9", 66, 48, 6.0},
                        Case{"gif", "gif", 65, 47, 8.0}, Case{"apng", "apng", 65, 47, 0.0}}) {
    SCOPED_TRACE(c.extension);
    const std::string film = "film." + c.extension;
    const ToolResult result = run({"video", "run", "-o", film, "--progress", "none"});
    ASSERT_EQ(result.status, 0) << result.errors;
    const Json stream = stream_of(film);
    EXPECT_EQ(stream["codec_name"], c.codec);
    EXPECT_EQ(stream["width"], c.width);
    EXPECT_EQ(stream["height"], c.height);
    EXPECT_EQ(stream["r_frame_rate"], "25/1");
    EXPECT_EQ(stream["nb_read_frames"], std::to_string(frames));
    EXPECT_LE(difference(film, 0), c.tolerance);
    EXPECT_LE(difference(film, frames - 1), c.tolerance);
  }
  const Json mp4 = stream_of("film.mp4");
  EXPECT_EQ(mp4["pix_fmt"], "yuv420p");
  for (const char* tag : {"color_space", "color_primaries", "color_transfer"}) EXPECT_EQ(mp4[tag], "bt709") << tag;
}

TEST_F(Video, SameFramesGiveTheSameBytes) {
  for (const std::string extension : {"mp4", "webm", "gif", "apng"}) {
    ASSERT_EQ(run({"video", "run", "-o", "a." + extension, "--progress", "none"}).status, 0);
    // On one processor: encoders left to themselves would choose fewer threads.
    const ToolResult alone = run_program(
        "taskset", {"1", BILLOW_TOOL, "video", "run", "-o", "b." + extension, "--progress", "none"}, folder_.path());
    ASSERT_EQ(alone.status, 0) << alone.errors;
    EXPECT_TRUE(test::read_text(path("a." + extension)) == test::read_text(path("b." + extension))) << extension;
  }
}

TEST_F(Video, ViewsStandSideBySide) {
  ASSERT_EQ(run({"video", "run", "--view", "velocity,textured", "--fps", "5", "-o", "both.apng"}).status, 0);
  const Json stream = stream_of("both.apng");
  EXPECT_EQ(stream["width"], 130);
  EXPECT_EQ(stream["r_frame_rate"], "5/1");
  EXPECT_EQ(stream["nb_read_frames"], std::to_string(frames));
  const render::Image left = render::read_png(path("run/velocity/frame_0001.png"));
  EXPECT_EQ(render::compare(frame_in("both.apng", 0), left).max, 0);
}

TEST_F(Video, OnlyTheFramesThatTheRunDrew) {
  ASSERT_EQ(run({"render", "scene.yaml", "-o", "part", "--frames", "3-5", "--progress", "none"}).status, 0);
  ASSERT_EQ(run({"video", "part", "--progress", "none"}).status, 0);
  EXPECT_EQ(stream_of("part/textured.mp4")["nb_read_frames"], "3");
}

TEST_F(Video, NamesWhatIsWrong) {
  const auto expect = [&](const std::vector<std::string>& arguments, int status, const std::string& words) {
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.status, status) << words;
    EXPECT_NE(result.errors.find(words), std::string::npos) << result.errors;
  };
  expect({"video", "run", "-o", "film.avi"}, 4, "a film's name ends in .mp4, .webm, .gif, .apng");
  expect({"video", "run", "--view", "velocty"}, 4, "did you mean 'velocity'?");
  expect({"video", "nowhere"}, 4, "nowhere/run.json: there is no such file; give the folder of a run");
  folder_.write("taken.mp4", "mine");
  expect({"video", "run", "-o", "taken.mp4"}, 6, "taken.mp4 already exists; use --overwrite");
  EXPECT_EQ(test::read_text(path("taken.mp4")), "mine");
  fs::remove(path("run/textured/frame_0004.png"));
  expect({"video", "run"}, 4, "run/textured/frame_0004.png: this frame of the run is missing");
  EXPECT_FALSE(fs::exists(path("run/textured.mp4")));
}

TEST_F(Video, DamagedFrameLeavesNoFilm) {
  folder_.write("run/textured/frame_0003.png", "no picture");
  const ToolResult result = run({"video", "run", "-o", "film.mp4"});
  EXPECT_EQ(result.status, 6);
  EXPECT_FALSE(fs::exists(path("film.mp4")));
}

TEST_F(Video, SaysWhereFfmpegComesFrom) {
  const ToolResult result =
      run_program("/usr/bin/env", {"PATH=" + path("nothing").string(), BILLOW_TOOL, "video", "run"}, folder_.path());
  EXPECT_EQ(result.status, 6);
  EXPECT_NE(result.errors.find("apt-get install ffmpeg"), std::string::npos) << result.errors;
}

// A program of ffmpeg's name that takes its time.
TEST_F(Video, InterruptEndsTheEncoderAndLeavesNoFile) {
  const fs::path encoder = folder_.write(
      "ffmpeg", "#!/bin/sh\ncd \"$(dirname \"$0\")\"\necho $$ > started.new\nmv started.new started\nexec sleep 60\n");
  fs::permissions(encoder, fs::perms::owner_all);
  fs::create_directory(path("out"));
  const ToolResult result = run_program(
      "/usr/bin/env",
      {"PATH=" + folder_.path().string() + ":/usr/bin:/bin", BILLOW_TOOL, "video", "run", "-o", "out/film.mp4"},
      folder_.path(), 0.1, path("started"));
  EXPECT_EQ(result.status, 130) << result.errors;
  EXPECT_TRUE(fs::is_empty(path("out")));
  EXPECT_EQ(kill(std::stoi(test::read_text(path("started"))), 0), -1);
}

TEST_F(Sheet, HoldsEvenlyChosenFrames) {
  ASSERT_EQ(run({"sheet", "run", "-n", "3", "--columns", "3"}).status, 0);
  const render::Image sheet = render::read_png(path("run/textured_sheet.png"));
  EXPECT_EQ(sheet.width, 2 * 28 + 3 * 300 + 2 * 12);
  ASSERT_EQ(run({"sheet", "run", "-n", "3", "--columns", "2", "--view", "textured,velocity", "-o", "two.png"}).status,
            0);
  EXPECT_EQ(render::read_png(path("two.png")).width, 2 * 28 + 4 * 300 + 3 * 12);
  EXPECT_EQ(run({"sheet", "run"}).status, 6);  // it is there
  EXPECT_EQ(run({"sheet", "run", "--overwrite"}).status, 0);
}

// Of six frames, two are the first and the last: another middle changes nothing, another end does.
TEST_F(Sheet, FirstAndLastFrameAreOnIt) {
  const auto sheet = [&] {
    EXPECT_EQ(run({"sheet", "run", "-n", "2", "--overwrite"}).status, 0);
    return test::read_text(path("run/textured_sheet.png"));
  };
  const auto replace = [&](int number) {
    fs::copy_file(path("run/velocity/frame_0001.png"), path(fmt::format("run/textured/frame_{:04}.png", number)),
                  fs::copy_options::overwrite_existing);
  };
  const std::string before = sheet();
  replace(3);
  EXPECT_TRUE(sheet() == before);
  replace(6);
  EXPECT_FALSE(sheet() == before);
}

}  // namespace
}  // namespace billow
