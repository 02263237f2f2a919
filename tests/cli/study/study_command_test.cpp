// billow study from outside: runs, resumption, failures, and what is made of them.
#include <sys/stat.h>

#include <fmt/format.h>

#include <fstream>
#include <future>
#include <nlohmann/json.hpp>

#include "render/image/png.h"
#include "tests/support/browser.h"
#include "tests/support/studying.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using test::plot_study;
using test::ToolResult;

class StudyCommand : public test::Studying {};

TEST_F(StudyCommand, MakesPlotTableRecordAndPage) {
  const ToolResult result = study();
  ASSERT_EQ(result.status, 0) << result.errors;
  for (const char* file : {"limits.png", "limits.svg", "limits.csv", "results.csv", "study.json", "index.html"})
    EXPECT_TRUE(fs::is_regular_file(made(file))) << file;
  const nlohmann::json runs = record()["runs"];
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[1]["settings"]["lambda"], "1");
  EXPECT_EQ(runs[1]["status"], "done");
  EXPECT_GT(runs[0]["values"]["paper_ratio"], runs[1]["values"]["paper_ratio"]);
}

TEST_F(StudyCommand, DoesNotRepeatWhatIsFinished) {
  ASSERT_EQ(study().status, 0);
  const auto before = fs::last_write_time(made("runs/001-0.5/result.json"));
  const ToolResult again = study();
  EXPECT_EQ(again.status, 0);
  EXPECT_NE(again.errors.find("2 runs, 2 of them finished already"), std::string::npos) << again.errors;
  EXPECT_EQ(fs::last_write_time(made("runs/001-0.5/result.json")), before);
}

TEST_F(StudyCommand, RepeatsWhatHasChanged) {
  ASSERT_EQ(study().status, 0);
  folder_.write("study.yaml", test::edited(plot_study, "[0.5, 1]", "[0.5, 4]"));
  const ToolResult again = study();
  EXPECT_EQ(again.status, 0);
  EXPECT_NE(again.errors.find("2 runs, 1 of them finished already"), std::string::npos) << again.errors;
}

TEST_F(StudyCommand, ListsRunsDoesOneAndCollects) {
  EXPECT_EQ(study({"--only", "2"}).status, 0);
  EXPECT_EQ(study({"--list"}).output, "   1  missing   0.5\n   2  done      1\n");
  EXPECT_FALSE(fs::exists(made("limits.png")));
  const ToolResult collected = study({"--collect"});
  EXPECT_EQ(collected.status, 1);
  EXPECT_NE(collected.errors.find("1 run is missing or failed"), std::string::npos) << collected.errors;
  EXPECT_TRUE(fs::exists(made("limits.png")));
  EXPECT_EQ(study({"--only", "3"}).status, 4);
}

TEST_F(StudyCommand, MarksADivergedRunAndGoesOn) {
  std::string text = test::edited(plot_study, "{name: lambda, key: solver.filter.lambda, values: [0.5, 1]}",
                                  "{name: h, key: solver.step, values: [0.001, 0.19]}");
  text = test::edited(text, "render: false", "render: false, repeats: 1");
  text = test::edited(text, "duration: 0.2", "duration: 20");
  folder_.write("study.yaml", test::edited(text, "x: lambda, y: [paper_ratio, certified_ratio]", "x: h, y: seconds"));
  const ToolResult result = study();
  EXPECT_EQ(result.status, 0) << result.errors;
  const nlohmann::json runs = record()["runs"];
  EXPECT_EQ(runs[0]["status"], "done");
  EXPECT_EQ(runs[1]["status"], "diverged");
  EXPECT_NE(runs[1]["message"].get<std::string>().find("the simulation diverged at step"), std::string::npos);
}

TEST_F(StudyCommand, ReportsTheLimitsOfASchemeThatGrowsAtEveryStep) {
  const std::string text = test::edited(plot_study, "{name: lambda, key: solver.filter.lambda, values: [0.5, 1]}",
                                        "{name: lambda, key: solver.filter, values: [none]}");
  folder_.write("study.yaml", test::edited(text, "duration: 0.2", "duration: 0.2, solver.method: forward_euler"));
  study();
  EXPECT_EQ(record()["runs"][0]["status"], "done");
  EXPECT_EQ(record()["runs"][0]["values"]["certified"], 0.0);
}

TEST_F(StudyCommand, KeepsAFailedRunsLastWords) {
  std::string text = test::edited(plot_study, "{name: lambda, key: solver.filter.lambda, values: [0.5, 1]}",
                                  "{name: lambda, key: solver.method, values: [fb_euler, forward_euler]}");
  text = test::edited(text, "render: false", "render: false, repeats: 1");
  folder_.write("study.yaml", test::edited(text, "duration: 0.2", "duration: 0.2, solver.filter: none"));
  const ToolResult result = study();
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(record()["runs"][1]["status"], "failed");
  EXPECT_NE(record()["runs"][1]["message"].get<std::string>().find("grows at every step"), std::string::npos);
}

TEST_F(StudyCommand, RendersStripsSpectraAndFrames) {
  folder_.write("study.yaml", R"(billow_study: 1
scene: scene.yaml
set: {duration: 0.2, strip: {step: 0.02}, spectrum: {step: 0.05, at: 0.1}}
axes:
  - {name: lambda, key: solver.filter.lambda, values: [0.5, 1]}
pictures:
  - {name: strips, kind: strips, rows: lambda, times: [0, 0.1]}
  - {name: frames, kind: frames, rows: lambda, times: [0, 0.1]}
  - {name: spectra, kind: spectra, columns: lambda}
  - {name: curves, kind: spectrum_curves, by: [lambda], log: [y]}
)");
  const ToolResult result = study();
  ASSERT_EQ(result.status, 0) << result.errors;
  for (const char* file : {"strips.png", "frames.png", "spectra.png", "curves.png"}) {
    const render::Image image = render::read_png(made(file));
    EXPECT_GT(image.width, 100) << file;
  }
  EXPECT_TRUE(fs::exists(made("curves.csv")));
  EXPECT_TRUE(fs::exists(made("runs/001-0.5/film/run.json")));
}

TEST_F(StudyCommand, MakesStripsWithoutTimes) {
  folder_.write("study.yaml",
                "billow_study: 1\nscene: scene.yaml\nset: {duration: 0.2, strip: {step: 0.02}}\n"
                "pictures: [{name: strips, kind: strips}, {name: timed, kind: strips, times: [0, 0.1]}]\n");
  const ToolResult result = study();
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_LT(render::read_png(made("strips.png")).height, render::read_png(made("timed.png")).height);
}

// A row for each value of its axis; what else varies stands below each picture, not in rows that look the same.

TEST_F(StudyCommand, GivesEachFrameOfASecondAxisItsLabel) {
  const std::string text = R"(billow_study: 1
scene: scene.yaml
set: {duration: 0.1, strip: none, render.size: [64, 48], render.views: [textured, velocity], render.velocity_range: 1}
axes:
  - {name: solver, values: [{label: explicit}, {label: implicit, set: {solver.method: imex, solver.step: 0.01}}]}
  - {name: lambda, key: solver.filter.lambda, values: [1, 2, 3]}
pictures:
  - {name: grid, kind: frames, rows: solver, times: [0.1]}
  - {name: films, kind: frames, rows: solver, times: [0, 0.1], views: [velocity]}
)";
  folder_.write("study.yaml", text);
  const ToolResult result = study();
  ASSERT_EQ(result.status, 0) << result.errors;
  const render::Image grid = render::read_png(made("grid.png")), films = render::read_png(made("films.png"));
  EXPECT_EQ(grid.width, 28 + 3 * 312 - 12 + 28) << "three pictures in a row";
  EXPECT_EQ(films.width, 28 + 2 * 312 - 12 + 28) << "two moments in a row";
  EXPECT_GT(films.height, 6 * 225) << "six rows";
  folder_.write("study.yaml", test::edited(text, "[1, 2, 3]", "[1, 2, 5]"));
  ASSERT_EQ(study().status, 0);
  EXPECT_NE(render::read_png(made("grid.png")).pixels, grid.pixels) << "the labels are drawn";
}

TEST_F(StudyCommand, DrawsWhatCameBeforeADivergence) {
  folder_.write("study.yaml", R"(billow_study: 1
scene: scene.yaml
set: {duration: 20, strip: {step: 0.1}, render.size: [64, 48], render.fps: 1}
axes: [{name: h, key: solver.step, values: [0.001, 0.19]}]
measure: {repeats: 1}
pictures:
  - {name: strips, kind: strips}
  - {name: cost, kind: plot, x: h, y: steps}
)");
  const ToolResult result = study();
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(record()["runs"][1]["status"], "diverged");
  EXPECT_TRUE(fs::exists(made("strips.png")));
  EXPECT_NE(test::read_text(made("cost.svg")).find(">Not shown: h = 0.19 s diverged.</text>"), std::string::npos);
}

TEST_F(StudyCommand, LeavesDivergedRunsOutOfSpectrumCurves) {
  folder_.write("study.yaml", R"(billow_study: 1
scene: scene.yaml
set: {duration: 20, spectrum: {step: 0.05, at: 0.1}, render.size: [64, 48], render.fps: 1}
axes: [{name: h, key: solver.step, values: [0.001, 0.19]}]
pictures: [{name: curves, kind: spectrum_curves, log: [y]}]
)");
  ASSERT_EQ(study().status, 0);
  EXPECT_NE(test::read_text(made("curves.svg")).find(">Not shown: h = 0.19 s diverged.</text>"), std::string::npos);
  EXPECT_EQ(test::read_text(made("curves.csv")).find("0.19"), std::string::npos);
}

TEST_F(StudyCommand, ShowsAFrameThatSeveralTimesAreNearestToOnce) {
  const std::string text =
      "billow_study: 1\nscene: scene.yaml\nset: {duration: 0.2, render.size: [64, 48], render.fps: 25}\n"
      "pictures: [{name: films, kind: frames, times: [0, 0.12, 0.121]}]\n";
  folder_.write("study.yaml", text);
  ASSERT_EQ(study().status, 0);
  const render::Image twice = render::read_png(made("films.png"));
  folder_.write("study.yaml", test::edited(text, ", 0.121", ""));
  ASSERT_EQ(study().status, 0);
  EXPECT_EQ(render::read_png(made("films.png")).pixels, twice.pixels);
}

TEST_F(StudyCommand, NamesTheFirstMissingRunsAndCountsTheOthers) {
  folder_.write("study.yaml", test::edited(plot_study, "[0.5, 1]", "[1, 2, 3, 4, 5, 6, 7]"));
  const ToolResult result = study({"--collect"});
  EXPECT_NE(result.errors.find("and 2 more"), std::string::npos) << result.errors;
  ASSERT_EQ(study({"--only", "1"}).status, 0);
  study({"--collect"});
  EXPECT_NE(test::read_text(made("limits.svg")).find("λ = 4 and 3 more are missing."), std::string::npos);
}

TEST_F(StudyCommand, NamesItsFolderInTheCommandToDoItAgain) {
  ASSERT_EQ(study().status, 0);
  EXPECT_NE(test::read_text(made("index.html")).find(">billow study study.yaml -o made</pre>"), std::string::npos);
}

TEST_F(StudyCommand, NamesWhatIsPlotted) {
  folder_.write("study.yaml", R"(billow_study: 1
scene: scene.yaml
set: {duration: 0.2}
axes:
  - {name: lambda, key: solver.filter.lambda, values: [1, 2]}
  - {name: form, key: solver.filter.form, values: [symmetric, conserving]}
measure: {render: false, repeats: 1}
pictures:
  - {name: several, kind: plot, x: lambda, y: [paper, certified], note: Once.}
  - {name: one, kind: plot, x: form, y: certified_ratio}
  - {name: none, kind: plot, x: lambda, y: iterations_per_solve}
)");
  const ToolResult result = study();
  EXPECT_NE(result.errors.find(
                "'none' is missing: there is no point to plot. Not shown: λ = 1, symmetric; λ = 1, conserving; λ = 2, "
                "symmetric and 1 more have no iterations_per_solve.\n"),
            std::string::npos)
      << result.errors;
  const std::string several = test::read_text(made("several.svg")), one = test::read_text(made("one.svg"));
  for (const char* text :
       {"largest stable step [s]", "λ [per mean rest length]", "symmetric", "certified at rest", "Once."})
    EXPECT_NE(several.find(fmt::format(">{}</text>", text)), std::string::npos) << text;
  for (const char* text : {"step [× unfiltered limit], certified at rest", "form", "conserving", "λ = 2"})
    EXPECT_NE(one.find(fmt::format(">{}</text>", text)), std::string::npos) << text;
  const std::string page = test::read_text(made("index.html"));
  EXPECT_EQ(page.find("Once."), page.rfind("Once.")) << "the picture has it; the page says it to those who cannot see";
}

// Every picture loads, nothing complains, and the page says what the runs were.

TEST_F(StudyCommand, MakesAPageThatABrowserOpens) {
  ASSERT_EQ(study().status, 0);
  const test::Screenshot page = test::screenshot(made(""), "index.html", 900, 1400);
  EXPECT_TRUE(page.console.empty()) << page.console.front();
  EXPECT_EQ(page.image.width, 900);
  const std::string html = test::read_text(made("index.html"));
  for (const char* part :
       {"limits.svg", "<td class=\"label\">0.5</td>", "results.csv", "billow study study.yaml --only 2"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_EQ(html.find("http"), std::string::npos) << "asks the network";
}

TEST_F(StudyCommand, SharesItsRunsWithOthers) {
  folder_.write("study.yaml", test::edited(plot_study, "[0.5, 1]", "[0.5, 1, 2, 3]"));
  std::vector<std::future<ToolResult>> others;
  std::vector<test::TemporaryFolder> homes(3);
  const std::string file = (folder_.path() / "study.yaml").string();
  for (const test::TemporaryFolder& home : homes)
    others.push_back(std::async(std::launch::async, [&] {
      return test::run_tool({"study", file, "-o", made("").string()}, home.path());
    }));
  std::string said;
  for (std::future<ToolResult>& other : others) {
    const ToolResult result = other.get();
    EXPECT_EQ(result.status, 0) << result.errors;
    said += result.errors;
  }
  for (const char* run : {"run 1, 0.5: done in", "run 2, 1: done in", "run 3, 2: done in", "run 4, 3: done in"}) {
    EXPECT_NE(said.find(run), std::string::npos) << said;
    EXPECT_EQ(said.find(run), said.rfind(run)) << said;
  }
  EXPECT_EQ(study({"--list"}).output, "   1  done      0.5\n   2  done      1\n   3  done      2\n   4  done      3\n");
}

// Repeats look for no signal before they are through.

TEST_F(StudyCommand, EndsItsRunsWhenItIsInterrupted) {
  std::string text = test::edited(plot_study, "render: false", "render: false, repeats: 1");
  folder_.write("study.yaml", test::edited(text, "duration: 0.2", "duration: 30000, solver.step: 0.0001, strip: none"));
  const ToolResult result =
      test::run_tool({"study", "study.yaml", "-o", "made"}, folder_.path(), 0.1, made("runs/001-0.5/log.txt"));
  EXPECT_EQ(result.status, 130) << result.errors;
  EXPECT_TRUE(result.errors.ends_with("\nstopped by SIGINT\n")) << result.errors;
  EXPECT_FALSE(fs::exists(made("runs/001-0.5/claim")));
  EXPECT_FALSE(fs::exists(made("runs/001-0.5/result.json")));
}

TEST_F(StudyCommand, SaysWhichRunsAnotherMachineIsAt) {
  ASSERT_EQ(study({"--only", "1"}).status, 0);
  fs::create_directories(made("runs/002-1"));
  folder_.write("made/runs/002-1/claim", "host: render07\nprocess: 12\nsince: 2026-01-02 03:04:05 UTC\nspace: x\n");
  EXPECT_EQ(study({"--list"}).output, "   1  done      0.5\n   2  running   1\n");
}

// Before any run: to find it out afterwards would cost them all.

// Frames below strips are the first run's, in one view; no other run needs it.

}  // namespace
}  // namespace billow
