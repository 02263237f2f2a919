// Work for other processes: its lists, lines and scripts, and that what they come to is what one process makes.
#include "cli/cluster/spread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "cli/run/frame_list.h"
#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using test::run_tool;
using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Lists, JoinNeighbours) {
  EXPECT_EQ(cli::list_text({1, 2, 3, 7, 9, 10}), "1-3,7,9-10");
  EXPECT_EQ(cli::list_text({4}), "4");
  EXPECT_EQ(cli::list_text({}), "");
}

TEST(Lists, AreCutIntoChunks) {
  EXPECT_THAT(cli::lists_of({1, 2, 4, 5, 6}, 2), ElementsAre("1-2", "4-5", "6"));
  EXPECT_THAT(cli::lists_of({1, 2}, 9), ElementsAre("1-2"));
  EXPECT_THAT(cli::lists_of({}, 3), IsEmpty());
}

TEST(Lists, OfManyPiecesFitIntoAnArray) {
  EXPECT_EQ(cli::pieces_a_task(250, 0, 32), 8);
  EXPECT_EQ(cli::pieces_a_task(1000, 0, 1000), 1);
  EXPECT_EQ(cli::pieces_a_task(1001, 0, 1001), 2);  // Slurm takes 1000 tasks
  EXPECT_EQ(cli::pieces_a_task(9, 4, 9), 4);
  EXPECT_EQ(cli::pieces_a_task(0, 0, 0), 1);
}

TEST(SbatchOptions, MayBeAnyButThoseOfTheScript) {
  EXPECT_FALSE(cli::sbatch_fault("--partition=long --time=2:00:00 -p x --account 'a b'"));
  for (const char* wrong :
       {"", "  ", "long", "--array=1-3", "--time=1 --array 3", "-a1-3", "-d afterok:3", "--dependency=x",
        "--time=1\n#SBATCH --array=1", "--wrap=ls", "--arr=0-3", "--chdir=/tmp", "-D /tmp"})
    EXPECT_TRUE(cli::sbatch_fault(wrong)) << wrong;
}

TEST(Lines, RefuseWhatALineCannotHold) {
  EXPECT_EQ(cli::shell_line({"a b", "it's", "x"}), R"('a b' 'it'\''s' x)");
  for (const char* wrong : {"a\nb", "a\x1b[1m", "\xff"}) EXPECT_THROW(cli::shell_line({wrong}), InputError) << wrong;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A study and a film of a scene in a folder whose name a shell would read otherwise.
class Spread : public testing::Test {
 protected:
  Spread() {
    folder_.scene(test::edited(test::base_scene, "duration: 2", "duration: 0.2"));
    folder_.write("study.yaml",
                  "billow_study: 1\nscene: scene.yaml\naxes:\n  - {name: lambda, key: solver.filter.lambda, values: "
                  "[0.5, 1, 2]}\npictures:\n  - {name: limits, kind: plot, x: lambda, y: paper_ratio}\n");
  }
  ToolResult billow(std::vector<std::string> arguments, double interrupt_after = -1.0,
                    const fs::path& when = {}) const {
    return run_tool(arguments, folder_.path(), interrupt_after, when);
  }
  ToolResult shell(const std::string& line) const { return test::run_program("sh", {"-c", line}, folder_.path()); }
  nlohmann::json record(const fs::path& run) const {
    nlohmann::json json = nlohmann::json::parse(test::read_text(folder_.path() / run / "run.json"));
    for (const char* key : {"seconds", "processor_seconds", "resident_kib"}) json.erase(key);
    return json;
  }
  // That a folder holds what another one holds, but for the record and the page, which say when and how long.
  void expect_same_files(const fs::path& a, const fs::path& b) const {
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / a)) {
      const fs::path file = entry.path().lexically_relative(folder_.path() / a);
      const bool timed =
          file.filename() == "run.json" || file.filename() == "index.html" || file.filename() == "log.txt";
      if (!entry.is_regular_file() || timed || *file.begin() == "states") continue;
      EXPECT_EQ(test::read_text(entry.path()), test::read_text(folder_.path() / b / file)) << file;
    }
  }

  test::SceneFolder folder_;
};

TEST_F(Spread, LinesDoWhatIsUnfinished) {
  ASSERT_EQ(billow({"study", "study.yaml", "-o", "it's made", "--runs", "2"}).status, 0);
  const auto lines =
      lines_of(billow({"study", "study.yaml", "-o", "it's made", "--commands", "--threads", "1"}).output);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[1], HasSubstr("--runs 3"));
  for (const std::string& line : lines) EXPECT_EQ(shell(line).status, 0) << line;
  EXPECT_EQ(billow({"study", "study.yaml", "-o", "it's made", "--commands"}).output, "");
  ASSERT_EQ(billow({"study", "study.yaml", "-o", "it's made", "--collect"}).status, 0);
  ASSERT_EQ(billow({"study", "study.yaml", "-o", "alone"}).status, 0);
  expect_same_files("alone", "it's made");
  EXPECT_EQ(record("alone/runs/001-0.5/film"), record("it's made/runs/001-0.5/film"));
}

TEST_F(Spread, RunsThatAreFinishedAreNotRepeated) {
  ASSERT_EQ(billow({"study", "study.yaml", "-o", "made", "--runs", "1,3"}).status, 0);
  const auto before = fs::last_write_time(folder_.path() / "made/runs/001-0.5/result.json");
  EXPECT_EQ(billow({"study", "study.yaml", "-o", "made", "--runs", "1-"}).status, 0);
  EXPECT_EQ(fs::last_write_time(folder_.path() / "made/runs/001-0.5/result.json"), before);
  EXPECT_FALSE(fs::exists(folder_.path() / "made/limits.png"));
  const ToolResult beyond = billow({"study", "study.yaml", "-o", "made", "--runs", "2-4"});
  EXPECT_EQ(beyond.status, 4);
  EXPECT_THAT(beyond.errors, HasSubstr("--runs 2-4: the study has runs 1 to 3"));
}

TEST_F(Spread, AnEmptyListIsNotEverything) {
  EXPECT_EQ(billow({"study", "study.yaml", "-o", "made", "--runs", ""}).status, 2);
  EXPECT_EQ(billow({"render", "scene.yaml", "-o", "made", "--frames", ""}).status, 2);
  EXPECT_FALSE(fs::exists(folder_.path() / "made"));
}

TEST_F(Spread, LinesNameTheBackendThatWasNamed) {
  EXPECT_THAT(billow({"study", "study.yaml", "-o", "made", "--commands"}).output, testing::Not(HasSubstr("--backend")));
  EXPECT_THAT(billow({"study", "study.yaml", "-o", "made", "--commands", "--backend", "auto"}).output,
              HasSubstr("--backend auto"));
  EXPECT_THAT(billow({"render", "scene.yaml", "-o", "made", "--slurm", "--backend", "egl"}).output,
              HasSubstr("--from made --backend egl --frames "));
}

TEST_F(Spread, FramesBeforeADivergenceAreNoFailure) {
  const std::vector<std::string> wild = {"-D", "duration=1",         "-D", "solver.step=0.02",
                                         "-D", "solver.watch=false", "-D", "solver.filter=none"};
  const auto with_wild = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), wild.begin(), wild.end());
    return billow(arguments);
  };
  ASSERT_EQ(with_wild({"simulate", "scene.yaml", "-o", "film"}).status, 5);
  EXPECT_EQ(with_wild({"render", "scene.yaml", "--from", "film", "--frames", "1-2", "--frames-only"}).status, 0);
  EXPECT_EQ(with_wild({"render", "scene.yaml", "--from", "film", "--frames", "1-", "--frames-only"}).status, 5);
}

TEST_F(Spread, ARunThatIsStoppedGoesOn) {
  const std::vector<std::string> one = {"study", "study.yaml", "-o", "made", "--runs", "1", "--resume"};
  folder_.write("study.yaml", test::edited(test::read_text(folder_.path() / "study.yaml"), "axes:",
                                           "set: {duration: 1.6, render.size: [640, 480], render.samples: 16}\naxes:"));
  const fs::path film = folder_.path() / "made/runs/001-0.5/film";
  ASSERT_EQ(billow(one, 0.0, film / "textured/frame_0002.png").status, 130);
  ASSERT_TRUE(fs::exists(film / "states/states.json"));
  EXPECT_FALSE(fs::exists(folder_.path() / "made/runs/001-0.5/claim"));
  const auto first = fs::last_write_time(film / "textured/frame_0001.png");
  EXPECT_EQ(billow(one).status, 0);
  EXPECT_EQ(fs::last_write_time(film / "textured/frame_0001.png"), first);
  EXPECT_FALSE(fs::exists(film / "states"));
  ASSERT_EQ(billow({"study", "study.yaml", "-o", "alone", "--only", "1"}).status, 0);
  expect_same_files("alone", "made");
  EXPECT_EQ(record("alone/runs/001-0.5/film"), record("made/runs/001-0.5/film"));
}

TEST_F(Spread, TheScriptOfAStudyHasItsUnfinishedRuns) {
  ASSERT_EQ(billow({"study", "study.yaml", "-o", "made", "--runs", "2"}).status, 0);
  const std::string script = billow({"study", "study.yaml", "-o", "made", "--slurm", "--array-limit", "7", "--sbatch",
                                     "--time=5", "--threads", "3"})
                                 .output;
  EXPECT_THAT(script, HasSubstr("#SBATCH --array=0-1%7\n"));
  EXPECT_THAT(script, HasSubstr("tasks=(\n  1 3\n)\n"));
  EXPECT_THAT(script, HasSubstr("#SBATCH --time=5\n"));
  EXPECT_THAT(script, HasSubstr("#SBATCH --cpus-per-task=3\n"));
  EXPECT_THAT(script, HasSubstr("--dependency=\"afterany:${runs%%;*}\""));
  EXPECT_EQ(shell("cat <<'EOF' | bash -n\n" + script + "EOF\n").status, 0);
  EXPECT_THAT(billow({"study", "study.yaml", "-o", "made", "--slurm", "--sbatch", "--array=1"}).errors,
              HasSubstr("--array=1 is what the script itself sets"));
}

TEST_F(Spread, FramesDrawnApartAndCollectedAreThoseOfADirectRun) {
  ASSERT_EQ(billow({"render", "scene.yaml", "-o", "film"}).status, 0);
  fs::rename(folder_.path() / "film", folder_.path() / "alone");
  ASSERT_EQ(billow({"simulate", "scene.yaml", "-o", "film"}).status, 0);
  const auto lines = lines_of(billow({"render", "scene.yaml", "--from", "film", "--commands", "--chunk", "2"}).output);
  ASSERT_GT(lines.size(), 1U);
  ASSERT_EQ(shell(lines[0]).status, 0);
  const ToolResult early = billow({"render", "scene.yaml", "--from", "film", "--collect"});
  EXPECT_EQ(early.status, 1);
  EXPECT_THAT(early.errors, HasSubstr("3 frames are missing or damaged; draw them with --frames 3-5"));
  EXPECT_EQ(record("film")["drawn"], (nlohmann::json{1, 2}));
  for (const std::string& line : lines) EXPECT_EQ(shell(line).status, 0) << line;
  EXPECT_EQ(billow({"render", "scene.yaml", "--from", "film", "--commands"}).output, "");
  ASSERT_EQ(billow({"render", "scene.yaml", "--from", "film", "--collect"}).status, 0);
  expect_same_files("alone", "film");
  EXPECT_EQ(record("alone"), record("film"));
}

TEST_F(Spread, FramesOfStatesThatAreTooFewAreNotHandedOut) {
  ASSERT_EQ(billow({"simulate", "scene.yaml", "-o", "film"}).status, 0);
  for (const char* how : {"--commands", "--slurm"}) {
    const ToolResult result = billow({"render", "scene.yaml", "-D", "duration=1", "--from", "film", how});
    EXPECT_EQ(result.status, 4);
    EXPECT_THAT(result.errors, HasSubstr("film/states: there are 5 frames, and the scene has 25; go on with"));
  }
}

TEST_F(Spread, ACollectedFilmHasNoDamagedFrame) {
  ASSERT_EQ(billow({"simulate", "scene.yaml", "-o", "film"}).status, 0);
  ASSERT_EQ(billow({"render", "scene.yaml", "--from", "film", "--frames-only"}).status, 0);
  fs::resize_file(folder_.path() / "film/textured/frame_0003.png", 100);
  const ToolResult collected = billow({"render", "scene.yaml", "--from", "film", "--collect"});
  EXPECT_EQ(collected.status, 1);
  EXPECT_THAT(collected.errors, HasSubstr("frame_0003.png is cut short"));
  EXPECT_THAT(billow({"render", "scene.yaml", "--from", "film", "--commands"}).output, HasSubstr("--frames 3\n"));
}

TEST_F(Spread, TheScriptOfAFilmSimulatesDrawsAndCollects) {
  const std::string script =
      billow({"render", "scene.yaml", "-o", "film", "--slurm", "--chunk", "2", "--video"}).output;
  EXPECT_THAT(script, HasSubstr("tasks=(\n  1-2 3-4 5\n)\n"));
  EXPECT_THAT(script, HasSubstr("--dependency=\"afterok:${simulate%%;*}\""));
  EXPECT_THAT(script, HasSubstr("--dependency=\"afterany:${frames%%;*}\""));
  EXPECT_THAT(script, HasSubstr("video film --overwrite"));
  EXPECT_FALSE(fs::exists(folder_.path() / "film"));
  const ToolResult unordered = billow({"render", "scene.yaml", "-o", "film", "--commands"});
  EXPECT_EQ(unordered.status, 4);
  EXPECT_THAT(unordered.errors, HasSubstr("billow simulate"));
}

TEST_F(Spread, WithoutSlurmSubmittingSaysWhereTheScriptIs) {
  const ToolResult result =
      shell("mkdir bin && ln -s $(command -v bash) $(command -v mkdir) bin && PATH=$PWD/bin '" BILLOW_TOOL
            "' study study.yaml -o made --slurm --submit");
  EXPECT_EQ(result.status, 6);
  EXPECT_THAT(result.errors,
              HasSubstr("there is no sbatch here; on a machine that submits to Slurm: bash made-slurm/submit.sh"));
  EXPECT_TRUE(fs::exists(folder_.path() / "made-slurm/submit.sh"));
}

}  // namespace
}  // namespace billow
