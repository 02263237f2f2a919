// Study files: what they mean, and what is wrong with bad ones.
#include "base/error.h"
#include "cli/study/study.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

const std::string base_study = R"(billow_study: 1
title: A small study
scene: scene.yaml
set: {duration: 1}
axes:
  - name: lambda
    key: solver.filter.lambda
    values: [0.5, 1, 2]
  - name: solver
    values:
      - {label: explicit}
      - {label: implicit, set: {solver.method: imex, solver.step: 0.01}}
measure: {render: false}
pictures:
  - {name: limits, kind: plot, x: lambda, y: [paper_ratio, step], by: [solver], where: {lambda: [0.5, 2]}, log: [x]}
)";

class StudyReader : public testing::Test {
 protected:
  StudyReader() { folder_.scene(test::base_scene); }
  cli::Study read(const std::string& text) { return cli::read_study(folder_.write("study.yaml", text)); }

  // The message that reading gives, its folder left out.
  std::string error(const std::string& find, const std::string& replacement) {
    try {
      read(test::edited(base_study, find, replacement));
    } catch (const InputError& error) {
      const std::string message = error.what(), folder = folder_.path().string() + "/";
      return message.starts_with(folder) ? message.substr(folder.size()) : message;
    }
    return "";
  }

  test::SceneFolder folder_;
};

TEST_F(StudyReader, MultipliesItsAxesTheLastOneFastest) {
  const cli::Study study = read(base_study);
  const std::vector<cli::StudyRun> runs = cli::runs_of(study);
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_EQ(cli::label_of(study, runs[0]), "0.5, explicit");
  EXPECT_EQ(cli::label_of(study, runs[3]), "1, implicit");
  EXPECT_EQ(runs[5].number, 6);
}

TEST_F(StudyReader, ChangesTheSceneInOrder) {
  const cli::Study study = read(base_study);
  const cli::Scene scene = cli::read_scene(study.scene, cli::overrides_of(study, cli::runs_of(study)[5]));
  EXPECT_EQ(scene.duration, 1.0);
  EXPECT_EQ(scene.solver.filter->lambda, 2.0);
  EXPECT_EQ(scene.solver.method, sim::Method::imex);
}

TEST_F(StudyReader, ReadsAPlot) {
  const cli::PictureSpec plot = read(base_study).pictures.at(0);
  EXPECT_EQ(plot.kind, cli::PictureKind::plot);
  EXPECT_EQ(plot.y, (std::vector<std::string>{"paper_ratio", "step"}));
  EXPECT_EQ(plot.by, std::vector<int>{1});
  EXPECT_TRUE(plot.log_x);
  EXPECT_FALSE(plot.log_y);
  EXPECT_FALSE(cli::selects(plot, {1, {1, 0}}));
  EXPECT_TRUE(cli::selects(plot, {1, {2, 0}}));
}

TEST_F(StudyReader, WithoutAxesHasOneRun) {
  const cli::Study study =
      read("billow_study: 1\nscene: scene.yaml\npictures: [{name: p, kind: frames, times: [0]}]\n");
  ASSERT_EQ(cli::runs_of(study).size(), 1u);
  EXPECT_TRUE(cli::overrides_of(study, cli::runs_of(study)[0]).empty());
}

TEST_F(StudyReader, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(error("axes:", "axis:"), "study.yaml:5:1: unknown key 'axis' in the study; did you mean 'axes'?");
  EXPECT_EQ(error("billow_study: 1\n", ""),
            "study.yaml:1:1: the study needs the key 'billow_study'; begin it with 'billow_study: 1'");
  EXPECT_EQ(error("scene: scene.yaml", "scene: sene.yaml"), "study.yaml:3:8: there is no scene file " +
                                                                (folder_.path() / "sene.yaml").string() +
                                                                "; the path is relative to this file's folder");
  EXPECT_EQ(error("kind: plot", "kind: pie"),
            "study.yaml:15:26: unknown kind 'pie'; known are: strips, spectra, frames, plot, spectrum_curves");
  EXPECT_EQ(error("x: lambda", "x: lamda"), "study.yaml:15:35: there is no column 'lamda'; did you mean 'lambda'?");
  EXPECT_EQ(error("y: [paper_ratio, step]", "y: measured_ratio"),
            "study.yaml:15:46: 'measured_ratio' is not measured; add 'measure: {measured: true}' to the study");
  EXPECT_EQ(error("y: [paper_ratio, step]", "y: [step, seconds]"),
            "study.yaml:15:53: 'seconds' is not measured; add 'measure: {repeats: 1}' to the study");
  EXPECT_EQ(error("x: lambda", "x: energy"),
            "study.yaml:15:35: 'energy' is not measured; add 'measure: {error: {until: …, set: {…}}}' to the study");
  EXPECT_EQ(error("by: [solver]", "by: [solvr]"), "study.yaml:15:72: there is no axis 'solvr'; did you mean 'solver'?");
  EXPECT_EQ(error("where: {lambda: [0.5, 2]}", "where: {lambda: 3}"),
            "study.yaml:15:97: the axis 'lambda' has no value '3'; it has: 0.5, 1, 2");
  EXPECT_EQ(error("[0.5, 1, 2]", "[0.5, 1, 0.5]"),
            "study.yaml:8:22: a second value '0.5' of the axis 'lambda'; the first is at " +
                (folder_.path() / "study.yaml:8:14").string());
  EXPECT_EQ(error("kind: plot, x: lambda, y: [paper_ratio, step], by: [solver], where: {lambda: [0.5, 2]}, log: [x]",
                  "kind: frames, times: [0]"),
            "study.yaml:15:26: a picture of frames needs rendered runs; set measure.render to true");
  EXPECT_EQ(error("name: solver", "name: k0"),
            "study.yaml:9:11: 'k0' is a column of the results; call the axis differently");
}

// Two pictures, or a picture and the study itself, would write the same file.
TEST_F(StudyReader, GivesEveryFileOneWriter) {
  EXPECT_EQ(
      error("name: limits", "name: Results"),
      "study.yaml:15:12: a picture named 'Results' would replace the study's own results.csv; call it differently");
  const std::string second = "kind: plot, x: lambda, y: step}\n  - {kind: plot, name: ";
  EXPECT_EQ(error("kind: plot, x: lambda", second + "limits, x: lambda"),
            "study.yaml:16:24: a second picture named 'limits'; the first is at " +
                (folder_.path() / "study.yaml:15:12").string());
  EXPECT_EQ(error("kind: plot, x: lambda", second + "Limits, x: lambda"),
            "study.yaml:16:24: a second picture named 'Limits'; the first is at " +
                (folder_.path() / "study.yaml:15:12").string() + "; some file systems take 'limits' for the same");
  EXPECT_EQ(read("billow_study: 1\nscene: scene.yaml\npictures: [{name: results, kind: frames, times: [0]}]\n")
                .pictures.front()
                .name,
            "results");
}

// A fault in what a study changes is reported in the study, not in the scene.
TEST_F(StudyReader, PlacesFaultsOfARunInTheStudy) {
  const cli::Study study = read(test::edited(base_study, "solver.method: imex", "solver.method: imx"));
  const std::string message = test::scene_error(study.scene, cli::overrides_of(study, cli::runs_of(study)[1]));
  EXPECT_EQ(message, "study.yaml:12:48: unknown method 'imx'; did you mean 'imex'?");
}

}  // namespace
}  // namespace billow
