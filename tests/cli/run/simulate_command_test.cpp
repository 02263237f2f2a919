// billow simulate and render --from: simulated once, drawn often, by anyone, extended at will.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "base/npz.h"
#include "cli/run/frame_list.h"
#include "tests/support/mesh_files.h"
#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using test::run_tool;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(FrameLists, AreRangesStepsAndSingleFrames) {
  using cli::frames_in;
  using cli::parse_frames;
  const auto listed = [](const char* text) { return frames_in(*parse_frames(text), 20); };
  EXPECT_EQ(listed("3-9").count(), 7);
  EXPECT_TRUE(listed("3-9").listed.empty());
  EXPECT_TRUE(listed("1-5,4-9,10-").listed.empty());
  EXPECT_EQ(listed("1-5,4-9,10-").last, 20);
  EXPECT_THAT(listed("7,1-3,15-:4").listed, ElementsAre(1, 2, 3, 7, 15, 19));
  EXPECT_FALSE(listed("7,1-3").contains(4));
  EXPECT_TRUE(listed("7,1-3").contains(7));
  EXPECT_THAT(listed("2-20:9223372036854775807").listed.size(), 0U);  // one frame is a range
  for (const char* wrong :
       {"", ",", "0", "3-2", "1-5:0", "1:5", "5:2-7", "1-5,", "a", "1-2-3", "-3", "1-99999999999999999999"})
    EXPECT_FALSE(parse_frames(wrong)) << wrong;
  EXPECT_THROW(listed("5-21"), InputError);
  EXPECT_THROW(listed("21-"), InputError);
}

TEST(FrameLists, AreNamedInWords) {
  const auto named = [](const char* text) { return cli::frames_text(cli::frames_in(*cli::parse_frames(text), 250)); };
  EXPECT_EQ(named("61"), "61");
  EXPECT_EQ(named("61-70"), "61–70");
  EXPECT_EQ(named("61-70,100-:50"), "61–70, 100–250 by 50");
  EXPECT_EQ(named("1,3,10-12,40,50"), "1, 3, 10–12, 40, 50");  // two are no pattern
  EXPECT_EQ(named("1,3,7,20-22,31,60,72,99,250"), "1, 3, 7, 20–22, …, 250");
}

/// Pins let go and a cloth falls on a sphere, with a fitted camera: all that a run remembers is in use.
std::string falling_scene(double duration) {
  return fmt::format(
      "billow: 1\nduration: {}\n"
      "bodies:\n"
      "  - name: drape\n"
      "    cloth:\n"
      "      mesh: cloth.obj\n"
      "      transform: {{scale: 0.09, rotate: [-90, 0, 0]}}\n"
      "      mass: 0.05\n"
      "      strain_limit: 0.1\n"
      "      pins: [{{corner: top_left, until: 0.3}}, {{corner: top_right, until: 1.5}}]\n"
      "colliders: [{{name: ball, sphere: {{centre: [0.3, -0.4, 0], radius: 0.3}}}}]\n"
      "wind: {{velocity: [0.5, 0, 1], gusts: {{strength: 0.5, period: 0.5}}}}\n"
      "render: {{size: [96, 64], fps: 25, samples: 1}}\n"
      "strip: {{step: 0.015}}\n",
      duration);
}

class Simulate : public testing::Test {
 protected:
  Simulate() {
    folder_.write("cloth.obj", test::mesh_file("obj", test::quad_grid(8, 8)));
    folder_.write("scene.yaml", falling_scene(1.0));
  }

  ToolResult run(std::vector<std::string> arguments, double interrupt_after = -1.0, const fs::path& when = {}) const {
    arguments.insert(arguments.begin() + 1, {"scene.yaml", "--progress", "plain"});
    return run_tool(arguments, folder_.path(), interrupt_after, when);
  }
  fs::path at(const std::string& file) const { return folder_.path() / file; }
  nlohmann::json record(const std::string& run) const {
    return nlohmann::json::parse(test::read_text(at(run + "/run.json")));
  }

  // That both folders hold the same files with the same bytes.
  void expect_equal(const std::string& a, const std::string& b) const {
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(at(a))) {
      if (!entry.is_regular_file()) continue;
      const fs::path other = at(b) / fs::relative(entry.path(), at(a));
      ASSERT_TRUE(fs::exists(other)) << other;
      EXPECT_TRUE(test::read_text(entry.path()) == test::read_text(other)) << other;
      ++files;
    }
    EXPECT_GT(files, 0);
    for (const auto& entry : fs::recursive_directory_iterator(at(b))) files -= entry.is_regular_file();
    EXPECT_EQ(files, 0);
  }

  test::TemporaryFolder folder_;
};

TEST_F(Simulate, KeepsEveryFramesStateAndDrawsNothing) {
  const ToolResult result = run({"simulate", "-o", "sim"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("wrote the states of 25 frames, velocity_strip.png (67 columns), run.json"));
  EXPECT_FALSE(fs::exists(at("sim/textured")));
  EXPECT_TRUE(fs::exists(at("sim/velocity_strip.png")));
  EXPECT_EQ(record("sim")["status"], "done");
  const Npz state = read_npz(at("sim/states/frame_0025.npz"));
  EXPECT_EQ(state.matrix_at("position").rows(), 64);
  EXPECT_NEAR(state.number_at("time"), 0.96, 0.01);
  EXPECT_EQ(state.number_at("moment"), 24.0 / 25.0);
  EXPECT_THAT(test::read_text(at("sim/index.html")), HasSubstr("No pictures: the states alone were kept."));
}

TEST_F(Simulate, StatesAreDrawnAsADirectRunDrawsThem) {
  ASSERT_EQ(run({"render", "-o", "direct"}).status, 0);
  ASSERT_EQ(run({"simulate", "-o", "sim"}).status, 0);
  const ToolResult part = run({"render", "--from", "sim", "-o", "film", "--frames", "20-,3-7:2"});
  ASSERT_EQ(part.status, 0) << part.errors;
  EXPECT_EQ(test::read_text(at("film/velocity/frame_0005.png")), test::read_text(at("direct/velocity/frame_0005.png")));
  EXPECT_FALSE(fs::exists(at("film/textured/frame_0004.png")));
  EXPECT_THAT(test::read_text(at("film/index.html")), HasSubstr("\"listed\":[3,5,7,20,21,22,23,24,25]"));
  EXPECT_THAT(test::read_text(at("film/index.html")), HasSubstr("Drawn so far, of 25 frames: 3–7 by 2, 20–25."));
  ASSERT_EQ(run({"render", "--from", "sim", "-o", "film"}).status, 0);
  expect_equal("film/textured", "direct/textured");
  expect_equal("film/velocity", "direct/velocity");
  EXPECT_EQ(record("film")["images_kept"], 18);
  EXPECT_EQ(record("film")["frames"], record("direct")["frames"]);
  EXPECT_EQ(record("film")["bounds"], record("direct")["bounds"]);
}

// Into the folder of the states themselves, which then is the run that it would have been.
TEST_F(Simulate, SeveralProcessesDrawIntoOneFolder) {
  ASSERT_EQ(run({"render", "-o", "direct"}).status, 0);
  ASSERT_EQ(run({"simulate", "-o", "sim"}).status, 0);
  std::vector<std::thread> processes;
  std::vector<int> status(3, -1);
  for (int p = 0; p < 3; ++p)
    processes.emplace_back([&, p] {
      status[p] = run({"render", "--from", "sim", "--threads", "1", "--frames", fmt::format("{}-:3", p + 1)}).status;
    });
  for (std::thread& process : processes) process.join();
  EXPECT_THAT(status, testing::Each(0));
  expect_equal("sim/textured", "direct/textured");
  expect_equal("sim/velocity", "direct/velocity");
  EXPECT_EQ(record("sim")["strip_columns"], record("direct")["strip_columns"]);
  EXPECT_THAT(test::read_text(at("sim/index.html")), HasSubstr("velocity_strip.png"));
}

// A run that is extended is the longer run, to the bit, whatever it remembered: contact, limited strain, gusts, pins
// that have let go; by frames already drawn, too, whose camera was another.
class Extended : public Simulate, public testing::WithParamInterface<const char*> {};

TEST_P(Extended, IsTheLongerRun) {
  const std::vector<std::string> solver = {"-D", fmt::format("solver={}", GetParam())};
  const auto simulate = [&](const std::string& output, double duration, const std::vector<std::string>& more = {}) {
    folder_.write("scene.yaml", falling_scene(duration));
    std::vector<std::string> arguments = {"simulate", "-o", output};
    arguments.insert(arguments.end(), solver.begin(), solver.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ToolResult result = run(arguments);
    ASSERT_EQ(result.status, 0) << result.errors;
  };
  simulate("whole", 2.4);
  simulate("sim", 1.6);
  const fs::file_time_type first = fs::last_write_time(at("sim/states/frame_0002.npz"));
  ASSERT_EQ(run({"render", "--from", "sim", "-D", "duration=1.6", solver[0], solver[1]}).status, 0);
  simulate("sim", 2.4, {"--resume"});
  EXPECT_EQ(fs::last_write_time(at("sim/states/frame_0002.npz")), first);
  EXPECT_FALSE(fs::exists(at("sim/textured/frame_0001.png")));  // of a camera that was fitted to less
  expect_equal("sim/states", "whole/states");
  EXPECT_EQ(test::read_text(at("sim/velocity_strip.png")), test::read_text(at("whole/velocity_strip.png")));
  EXPECT_EQ(record("sim")["frames"], record("whole")["frames"]);
  EXPECT_EQ(record("sim")["solver"], record("whole")["solver"]);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Extended,
                         testing::Values("{}", "{method: backward_euler, step: 0.01}",
                                         "{filter: {kernel: exponential, lambda: 1, target: velocity}}"));

TEST_F(Simulate, GoesOnWhereItWasInterrupted) {
  folder_.write("scene.yaml", falling_scene(20.0));
  ASSERT_EQ(run({"simulate", "-o", "whole"}).status, 0);
  const ToolResult interrupted = run({"simulate", "-o", "sim"}, 0.0, at("sim/states/checkpoint.npz"));
  ASSERT_EQ(interrupted.status, 130) << interrupted.errors;
  EXPECT_EQ(run({"render", "--from", "sim", "-o", "film"}).status, 4);
  const ToolResult resumed = run({"simulate", "-o", "sim", "--resume"});
  ASSERT_EQ(resumed.status, 0) << resumed.errors;
  expect_equal("sim/states", "whole/states");
}

TEST_F(Simulate, ARenderResumesFromTheStatesInItsFolder) {
  ASSERT_EQ(run({"simulate", "-o", "sim"}).status, 0);
  const fs::file_time_type first = fs::last_write_time(at("sim/states/frame_0002.npz"));
  ASSERT_EQ(run({"render", "--resume", "-o", "sim"}).status, 0);
  EXPECT_EQ(fs::last_write_time(at("sim/states/frame_0002.npz")), first);
  ASSERT_EQ(run({"render", "-o", "direct"}).status, 0);
  expect_equal("sim/textured", "direct/textured");
}

TEST_F(Simulate, SaysWhatDoesNotFit) {
  ASSERT_EQ(run({"simulate", "-o", "sim"}).status, 0);
  const auto refusal = [&](std::vector<std::string> more, int status) {
    more.insert(more.begin(), {"render", "--from", "sim", "-o", "film"});
    const ToolResult result = run(more);
    EXPECT_EQ(result.status, status) << result.errors;
    return result.errors;
  };
  EXPECT_THAT(refusal({"-D", "bodies.drape.cloth.mass=0.06"}, 4), HasSubstr("a scene that moves otherwise"));
  EXPECT_THAT(refusal({"-D", "render.fps=50"}, 4), HasSubstr("a scene that moves otherwise"));
  EXPECT_THAT(refusal({"-D", "duration=1.2"}, 4), HasSubstr("there are 25 frames, and the scene has 30; go on with"));
  EXPECT_THAT(refusal({"--frames", "26"}, 4), HasSubstr("--frames 26: the scene has frames 1 to 25"));
  EXPECT_THAT(refusal({"--resume"}, 2), HasSubstr("--from"));
  EXPECT_EQ(run({"render", "--from", "none"}).status, 4);
  EXPECT_FALSE(fs::exists(at("none")));
  // Other pictures of the same motion are welcome, elsewhere.
  EXPECT_EQ(run({"render", "--from", "sim", "-o", "large", "-D", "render.size=[128, 96]", "-D", "strip=none"}).status,
            0);
  EXPECT_EQ(run({"render", "--from", "sim", "-D", "render.size=[128, 96]"}).status, 6);
  folder_.write("sim/states/frame_0003.npz", "PK damaged");
  EXPECT_THAT(refusal({}, 4), HasSubstr("frame_0003.npz"));
  folder_.write("sim/states/states.json", "{}");
  EXPECT_THAT(refusal({}, 4), HasSubstr("is no record of states; simulate again"));
}

TEST_F(Simulate, OverwritingRemovesStatesAndNothingElse) {
  ASSERT_EQ(run({"simulate", "-o", "sim"}).status, 0);
  folder_.write("sim/states/frame_notes.txt", "mine");
  ASSERT_EQ(run({"render", "-o", "sim", "--overwrite"}).status, 0);
  EXPECT_FALSE(fs::exists(at("sim/states/frame_0001.npz")));
  EXPECT_FALSE(fs::exists(at("sim/states/states.json")));
  EXPECT_TRUE(fs::exists(at("sim/states/frame_notes.txt")));
}

}  // namespace
}  // namespace billow
