// billow render from outside: what it writes, what it refuses, how it ends.
#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>

#include "render/image/png.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using test::run_tool;
using test::ToolResult;

// A cloth of 12 x 12 particles, 96 x 64 pixels, eleven frames; `solver` is the solver section in one line.
std::string small_scene(const std::string& solver = "{method: fb_euler}", double duration = 0.44) {
  return "billow: 1\nduration: " + std::to_string(duration) +
         "\nbodies:\n"
         "  - name: drape\n"
         "    cloth:\n"
         "      mesh: cloth.obj\n"
         "      transform: {scale: 0.0909}\n"
         "      mass: 0.05\n"
         "      stiffness: {max_eigenvalue: 100000}\n"
         "      pins: [{corner: top_left}, {corner: top_right}]\n"
         "    colour: \"#2f7f86\"\n"
         "solver: " +
         solver +
         "\nrender: {size: [96, 64], fps: 25, samples: 4}\n"
         "strip: {step: 0.02}\n";
}

class RenderCommand : public testing::Test {
 protected:
  RenderCommand() {
    folder_.write("cloth.obj", test::mesh_file("obj", test::quad_grid(12, 12)));
    scene(small_scene());
  }

  void scene(const std::string& text) { folder_.write("scene.yaml", text); }

  ToolResult render(std::vector<std::string> more = {}, double interrupt_after = -1.0,
                    const fs::path& interrupt_when = {}) {
    std::vector<std::string> arguments{"render", "scene.yaml", "-o", "film", "--progress", "plain"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments, folder_.path(), interrupt_after, interrupt_when);
  }

  fs::path film(const std::string& file) const { return folder_.path() / "film" / file; }
  nlohmann::json record() const { return nlohmann::json::parse(test::read_text(film("run.json"))); }

  // Number of files in a folder of the film; every one must be a whole PNG.
  int whole_images(const std::string& view) const {
    int images = 0;
    for (const auto& entry : fs::directory_iterator(film(view))) {
      EXPECT_NO_THROW(render::read_png(entry.path())) << entry.path();
      ++images;
    }
    return images;
  }

  test::TemporaryFolder folder_;
};

TEST_F(RenderCommand, WritesFramesStripAndRecord) {
  const ToolResult result = render();
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(whole_images("textured"), 11);
  EXPECT_EQ(whole_images("velocity"), 11);
  const render::Image strip = render::read_png(film("velocity_strip.png"));
  EXPECT_EQ(strip.width, 22);
  EXPECT_EQ(strip.height, 144);
  EXPECT_EQ(record()["status"], "done");
  EXPECT_EQ(record()["frames"].size(), 11u);
  EXPECT_NE(result.errors.find("wrote 22 images, velocity_strip.png (22 columns), run.json and index.html to film"),
            std::string::npos)
      << result.errors;
}

TEST_F(RenderCommand, SaysEverythingInJsonWhenAskedTo) {
  const ToolResult result = run_tool({"render", "scene.yaml", "-o", "film", "--progress", "json"}, folder_.path());
  ASSERT_EQ(result.status, 0) << result.errors;
  std::istringstream lines(result.errors);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_TRUE(nlohmann::json::parse(line, nullptr, false).is_object()) << line;
  EXPECT_GE(count, 2);
}

TEST_F(RenderCommand, GivesTheSameBytesTwiceAndOnAnyNumberOfThreads) {
  ASSERT_EQ(render({"--threads", "1"}).status, 0);
  fs::rename(film(""), folder_.path() / "first");
  ASSERT_EQ(render({"--threads", "3"}).status, 0);
  for (const char* file : {"textured/frame_0011.png", "velocity/frame_0011.png", "velocity_strip.png"})
    EXPECT_EQ(test::read_text(film(file)), test::read_text(folder_.path() / "first" / file)) << file;
}

TEST_F(RenderCommand, DrawsAPartAsInTheWhole) {
  ASSERT_EQ(render().status, 0);
  fs::rename(film(""), folder_.path() / "whole");
  ASSERT_EQ(render({"--frames", "4-6"}).status, 0);
  EXPECT_EQ(whole_images("velocity"), 3);
  for (const char* file : {"textured/frame_0005.png", "velocity/frame_0006.png"})
    EXPECT_EQ(test::read_text(film(file)), test::read_text(folder_.path() / "whole" / file)) << file;
}

// All that a survey would find out.
const std::vector<std::string> everything_given = {"-D", "render.camera={eye: [0.3, -0.2, 2.6], look_at: [0, -0.4, 0]}",
                                                   "-D", "render.ground=-1.2",
                                                   "-D", "render.velocity_range=2"};

TEST_F(RenderCommand, SurveysOnlyWhatItsSceneLeavesOpen) {
  ASSERT_EQ(render(everything_given).status, 0);
  EXPECT_EQ(record()["seconds"]["survey"], 0.0);
  fs::rename(film(""), folder_.path() / "whole");
  std::vector<std::string> part = everything_given;
  part.insert(part.end(), {"--frames", "3-4"});
  ASSERT_EQ(render(part).status, 0);
  EXPECT_EQ(record()["seconds"]["survey"], 0.0);
  EXPECT_EQ(whole_images("textured"), 2);
  for (const char* file : {"textured/frame_0003.png", "textured/frame_0004.png", "velocity/frame_0003.png"})
    EXPECT_EQ(test::read_text(film(file)), test::read_text(folder_.path() / "whole" / file)) << file;
  part.insert(part.end(), {"-D", "render.velocity_range=auto", "--overwrite"});
  ASSERT_EQ(render(part).status, 0);
  EXPECT_GT(record()["seconds"]["survey"], 0.0);
}

TEST_F(RenderCommand, AccountsForTheWallClock) {
  scene(small_scene("{method: fb_euler}", 4.0));
  const auto begin = std::chrono::steady_clock::now();
  const ToolResult result = render();
  const double outside = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ASSERT_EQ(result.status, 0) << result.errors;
  const nlohmann::json seconds = record()["seconds"];
  double phases = 0.0;
  for (const char* name : {"start", "reading", "springs", "limit", "surfaces", "survey", "render", "writing"})
    phases += seconds[name].get<double>();
  EXPECT_NEAR(phases, seconds["wall"], 0.02 * phases);
  EXPECT_LT(seconds["wall"], 1.02 * outside);
#ifndef BILLOW_SANITIZE                       // which look for leaks after the end
  EXPECT_GT(seconds["wall"], 0.9 * outside);  // the tool that runs it waits, too
#endif
  for (const char* name :
       {" s (start ", ", reading ", ", springs ", ", limit ", ", survey ", ", render ", ", writing "})
    EXPECT_NE(result.errors.find(name, result.errors.find("wrote ")), std::string::npos) << result.errors;
  EXPECT_NE(test::read_text(film("index.html")).find("limit "), std::string::npos);
}

// 10,000 frames may take 1 MiB more than the first 100 did; of that the renderer's own buffers take the most.
TEST_F(RenderCommand, HoldsNoMoreMemoryForALongFilm) {
#ifdef BILLOW_SANITIZE
  GTEST_SKIP() << "the address sanitizer keeps what has been freed";
#endif
  scene(small_scene("{method: fb_euler}", 80.0));
  const ToolResult result = render({"-D", "render.size=[16, 16]", "-D", "render.samples=1", "-D", "strip.step=0.1"});
  ASSERT_EQ(result.status, 0) << result.errors;
  ASSERT_EQ(record()["images_written"], 4000);
  const nlohmann::json memory = record()["resident_kib"];
  EXPECT_GT(memory["after_100_frames"], 1024);
  EXPECT_LE(memory["end"].get<long>() - memory["after_100_frames"].get<long>(), 1024);
}

TEST_F(RenderCommand, RefusesAFolderThatHoldsSomething) {
  fs::create_directories(film(""));
  folder_.write("film/diary.txt", "mine");
  const ToolResult result = render();
  EXPECT_EQ(result.status, 6);
  EXPECT_NE(result.errors.find("film already holds files; use --overwrite"), std::string::npos) << result.errors;
  EXPECT_FALSE(fs::exists(film("run.json")));
  ASSERT_EQ(render({"--overwrite"}).status, 0);
  EXPECT_EQ(test::read_text(film("diary.txt")), "mine");
}

TEST_F(RenderCommand, OverwritingLeavesNoFrameOfTheEarlierRun) {
  ASSERT_EQ(render().status, 0);
  scene(small_scene("{method: fb_euler}", 0.2));
  ASSERT_EQ(render({"--overwrite"}).status, 0);
  EXPECT_EQ(whole_images("textured"), 5);
}

TEST_F(RenderCommand, ResumesOnlyWhatIsMissing) {
  ASSERT_EQ(render().status, 0);
  const std::string before = test::read_text(film("textured/frame_0007.png"));
  fs::remove(film("textured/frame_0007.png"));
  ASSERT_EQ(render({"--resume"}).status, 0);
  EXPECT_EQ(record()["images_written"], 1);
  EXPECT_NE(test::read_text(film("index.html")).find("1 written, 21 kept from an earlier run"), std::string::npos);
  EXPECT_EQ(record()["images_kept"], 21);
  EXPECT_EQ(test::read_text(film("textured/frame_0007.png")), before);
}

// As a run leaves them that met a fault before its first file.
TEST_F(RenderCommand, TakesAFolderOfEmptyFoldersForAnEmptyOne) {
  for (const char* more : {"--resume", "--threads=2"}) {
    fs::remove_all(film(""));
    fs::create_directories(film("textured"));
    fs::create_directories(film("velocity"));
    folder_.write("film/.run.json.00000000-1-0.part", "");
    EXPECT_EQ(render({more}).status, 0) << more;
    EXPECT_EQ(record()["status"], "done");
  }
}

TEST_F(RenderCommand, SaysInItsRecordThatItFailedAndWhy) {
  fs::create_directories(film("textured/frame_0009.png/in the way"));
  folder_.write("film/run.json", "");
  const ToolResult failed = render({"--overwrite"});
  EXPECT_EQ(failed.status, 6);
  EXPECT_EQ(record()["status"], "failed");
  EXPECT_EQ(record()["error"], "cannot write film/textured/frame_0009.png: it exists and is not a file");
  const ToolResult sheet = run_tool({"sheet", "film"}, folder_.path());
  EXPECT_EQ(sheet.status, 4);
  EXPECT_EQ(sheet.errors, "film/run.json: this run has failed; finish it with 'billow render --resume'\n");

  fs::remove_all(film("textured/frame_0009.png"));
  EXPECT_EQ(render({"--resume"}).status, 0);
  EXPECT_EQ(record()["status"], "done");
  EXPECT_FALSE(record().contains("error"));
  EXPECT_EQ(whole_images("textured"), 11);
}

TEST_F(RenderCommand, LeavesNoStripThatIsTooShort) {
  scene(small_scene("{method: fb_euler}", 200.0));
  fs::create_directories(film("velocity/frame_0003.png/in the way"));
  folder_.write("film/run.json", "");
  EXPECT_EQ(render({"--overwrite"}).status, 6);
  EXPECT_FALSE(fs::exists(film("velocity_strip.png")));
  EXPECT_FALSE(fs::exists(film("frames.csv")));
  const std::string page = test::read_text(film("index.html"));
  for (const char* part :
       {"This run failed: ", "frame_0003.png", "The same command with --resume in place of --overwrite"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(RenderCommand, IsNotDoneWithoutItsPage) {
  fs::create_directories(film("index.html/in the way"));
  folder_.write("film/run.json", "");
  EXPECT_EQ(render({"--overwrite"}).status, 6);
  EXPECT_EQ(record()["status"], "failed");
  EXPECT_EQ(whole_images("textured"), 11);
}

TEST_F(RenderCommand, DoesNotResumeAnotherScene) {
  ASSERT_EQ(render().status, 0);
  const ToolResult result = render({"--resume", "-D", "bodies.drape.cloth.mass=0.06"});
  EXPECT_EQ(result.status, 6);
  EXPECT_NE(result.errors.find("is not of this scene"), std::string::npos) << result.errors;
}

// What stands on the page can be pasted as it is: the folder holds the run by then.
TEST_F(RenderCommand, ItsPageSaysHowToReplaceTheRun) {
  ASSERT_EQ(render().status, 0);
  EXPECT_NE(test::read_text(film("index.html")).find(" --overwrite</pre>"), std::string::npos);
  EXPECT_EQ(record()["command"].get<std::string>().find("--overwrite"), std::string::npos);
}

TEST_F(RenderCommand, AdvisesNoStepWhereNoneIsStable) {
  scene(small_scene("{method: forward_euler, step: 0.05}"));
  const ToolResult result = render();
  EXPECT_EQ(result.status, 5);
  EXPECT_NE(result.errors.find("forward_euler grows at every step here; use another method or add damping"),
            std::string::npos)
      << result.errors;
}

TEST_F(RenderCommand, StopsAtADivergenceAndKeepsTheFramesBeforeIt) {
  scene(small_scene("{method: fb_euler, step: 0.01}"));
  const ToolResult result = render();
  EXPECT_EQ(result.status, 5);
  EXPECT_NE(result.errors.find("the simulation diverged at step "), std::string::npos) << result.errors;
  EXPECT_NE(result.errors.find("particle "), std::string::npos);
  EXPECT_NE(result.errors.find("the limit for fb_euler is 0.006"), std::string::npos) << result.errors;
  EXPECT_EQ(record()["status"], "diverged");
  const int frames = whole_images("textured");
  EXPECT_GE(frames, 1);
  EXPECT_LT(frames, 11);
}

TEST_F(RenderCommand, FinishesCleanlyWhenInterrupted) {
  scene(small_scene("{method: fb_euler}", 200.0));
  const ToolResult result = render({}, 0.1, film("velocity/frame_0003.png"));
  EXPECT_EQ(result.status, 130) << result.errors;
  EXPECT_TRUE(result.errors.ends_with("\nstopped by SIGINT\n")) << result.errors;
  EXPECT_EQ(record()["status"], "interrupted");
  EXPECT_NE(test::read_text(film("index.html")).find("This run was interrupted by SIGINT at "), std::string::npos);
  EXPECT_GE(whole_images("textured"), 3);
  EXPECT_LT(whole_images("textured"), 5000);
  EXPECT_EQ(whole_images("textured") + whole_images("velocity"), record()["images_written"]);
}

TEST_F(RenderCommand, KeepsTheEarlierFilmWhenInterruptedBeforeTheFirstFrame) {
  ASSERT_EQ(render().status, 0);
  scene(small_scene("{method: fb_euler, step: 0.000002}", 400.0));
  EXPECT_EQ(render({"--overwrite"}, 1.0).status, 130);  // within its survey
  EXPECT_EQ(whole_images("textured"), 11);
  EXPECT_EQ(record()["status"], "done");
}

TEST_F(RenderCommand, ResumesNoFolderThatHasNoRun) {
  folder_.write("film/notes.txt", "mine");
  const ToolResult result = render({"--resume"});
  EXPECT_EQ(result.status, 6);
  EXPECT_NE(result.errors.find("film holds files but no run.json, so there is no run to resume; use"),
            std::string::npos)
      << result.errors;
  EXPECT_EQ(test::read_text(film("notes.txt")), "mine");
}

TEST_F(RenderCommand, SurvivesADamagedRecord) {
  ASSERT_EQ(render().status, 0);
  folder_.write("film/run.json", "{\"scene\": 5}");
  EXPECT_EQ(render({"--resume"}).status, 6);
}

TEST_F(RenderCommand, ReportsAFolderThatCannotBeMade) {
  folder_.write("film", "a file, not a folder");
  const ToolResult result = render();
  EXPECT_EQ(result.status, 6);
  EXPECT_NE(result.errors.find("film is not a folder"), std::string::npos) << result.errors;
}

TEST_F(RenderCommand, ChecksTheSceneBeforeItTouchesTheFolder) {
  ASSERT_EQ(render().status, 0);
  scene(small_scene("{methd: fb_euler}"));
  const ToolResult result = render({"--overwrite"});
  EXPECT_EQ(result.status, 4);
  EXPECT_EQ(result.errors, "scene.yaml:12:10: unknown key 'methd' in solver; did you mean 'method'?\n");
  EXPECT_EQ(whole_images("textured"), 11);
}

TEST_F(RenderCommand, EveryMethodMakesAFilm) {
  for (const char* solver :
       {"{method: forward_euler, filter: {form: plain}}", "{method: verlet, filter: {target: force, form: conserving}}",
        "{method: rk4}", "{method: backward_euler}", "{method: backward_euler, linear_solver: cholesky}",
        "{method: imex}"}) {
    scene(small_scene(solver, 0.12));
    const ToolResult result = render({"--overwrite"});
    EXPECT_EQ(result.status, 0) << solver << "\n" << result.errors;
  }
}

TEST_F(RenderCommand, SaysWhereItMayNotWrite) {
  const ToolResult result = run_tool({"render", "scene.yaml", "-o", "/sys/film"}, folder_.path());
  EXPECT_EQ(result.status, 6);
  EXPECT_NE(result.errors.find("cannot make the folder /sys/film: "), std::string::npos) << result.errors;
  EXPECT_NE(result.errors.find("; name one where you may write"), std::string::npos) << result.errors;
}

TEST_F(RenderCommand, SaysWhatIsWrongWithItsArguments) {
  EXPECT_EQ(render({"--frames", "0-3"}).status, 2);
  EXPECT_EQ(render({"--frames", "5-3"}).status, 2);
  EXPECT_EQ(render({"-D", "no-equals-sign"}).status, 2);
  EXPECT_EQ(render({"--overwrite", "--resume"}).status, 2);
  EXPECT_EQ(render({"--resume", "--frames", "2"}).status, 2);
  EXPECT_EQ(render({"--threads", "0"}).status, 2);
  EXPECT_EQ(render({"--frames", "1-12"}).status, 4);
  EXPECT_EQ(run_tool({"rendr", "scene.yaml"}, folder_.path()).status, 2);
}

}  // namespace
}  // namespace billow
