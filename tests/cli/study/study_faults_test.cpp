// billow study from outside: what is refused, what is damaged, and what is missing.
#include <sys/stat.h>

#include <fstream>

#include "tests/support/studying.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using test::plot_study;
using test::ToolResult;

class StudyFaults : public test::Studying {};

TEST_F(StudyFaults, RefusesTimesAfterTheEndBeforeItRuns) {
  folder_.write("study.yaml", R"(billow_study: 1
scene: scene.yaml
set: {duration: 0.2}
pictures: [{name: films, kind: frames, times: [0.1, 3]}]
)");
  const ToolResult result = study();
  EXPECT_EQ(result.status, 4);
  EXPECT_NE(result.errors.find("study.yaml:4:53: the picture 'films' wants a frame at 3 s, and its runs end at 0.2 s"),
            std::string::npos)
      << result.errors;
  EXPECT_FALSE(fs::exists(made("runs")));
}

TEST_F(StudyFaults, SaysWhatIsInAResultsPlace) {
  ASSERT_EQ(study().status, 0);
  const fs::path result = made("runs/002-1/result.json");
  fs::remove(result);
  fs::create_directory(result);
  const std::string file = "made/runs/002-1/result.json: ";
  for (const std::string option : {"--collect", "--list", "--overwrite"}) {
    const ToolResult refused = study({option});
    EXPECT_EQ(refused.status, 4) << option;
    EXPECT_NE(refused.errors.find(file + "this is a folder, not a file; move it away or remove it"), std::string::npos)
        << refused.errors;
  }
  fs::remove(result);
  ASSERT_EQ(mkfifo(result.c_str(), 0600), 0);
  EXPECT_EQ(study().errors,
            file + "this is not a regular file; move it away or remove it, and the run is done again\n");
}

TEST_F(StudyFaults, DoesARunWithADamagedResultAgain) {
  ASSERT_EQ(study().status, 0);
  const std::string whole = test::read_text(made("runs/002-1/result.json"));
  for (const std::string& bytes : {whole.substr(0, whole.size() / 2), std::string("[1]"), std::string("\xff"),
                                   test::edited(whole, "\"status\": \"done\"", "\"status\": \"gone\"")}) {
    folder_.write("made/runs/002-1/result.json", bytes);
    const ToolResult again = study();
    EXPECT_EQ(again.status, 0);
    EXPECT_NE(again.errors.find("warning: run 2, 1: its result.json is damaged and counts as none; it is done again"),
              std::string::npos)
        << again.errors;
    EXPECT_EQ(test::read_text(made("runs/002-1/result.json")), whole);
  }
}

TEST_F(StudyFaults, SaysWhichRunsPictureLacksWhat) {
  folder_.write("study.yaml", R"(billow_study: 1
scene: scene.yaml
set: {duration: 0.1, spectrum: {step: 0.05, at: 0.1}}
axes:
  - {name: lambda, key: solver.filter.lambda, values: [0.5, 1]}
pictures:
  - {name: strips, kind: strips, times: [0, 0.1]}
  - {name: curves, kind: spectrum_curves}
)");
  ASSERT_EQ(study().status, 0);
  const std::string again = "; do the run again with 'billow study study.yaml -o made --only 2'\n";
  folder_.write("made/runs/002-1/film/spectrum.csv", "frequency,power\n0,1\n1,x\n");
  fs::remove(made("runs/002-1/film/velocity_strip.png"));
  ToolResult result = study();
  EXPECT_EQ(result.status, 1);
  for (const std::string& line :
       {"'strips' is missing: of run 2, made/runs/002-1/film/velocity_strip.png is missing" + again,
        "'curves' is missing: of run 2, made/runs/002-1/film/spectrum.csv:3: '1,x' is no row of a spectrum; the file "
        "is "
        "damaged" +
            again})
    EXPECT_NE(result.errors.find("warning: the picture " + line), std::string::npos) << result.errors;
  fs::remove_all(made("runs/002-1/film"));
  result = study();
  EXPECT_NE(result.errors.find("of run 2, made/runs/002-1/film is missing" + again), std::string::npos)
      << result.errors;
  fs::remove_all(made("runs"));
  result = study({"--collect"});
  EXPECT_NE(result.errors.find("none of its runs is finished: run 1 is missing, run 2 is missing"), std::string::npos)
      << result.errors;
}

TEST_F(StudyFaults, SaysWhatItsSceneLacksForAPicture) {
  const auto fault = [&](const std::string& set, const std::string& picture) {
    folder_.write("study.yaml", "billow_study: 1\nscene: scene.yaml\nset: {duration: 0.1, " + set +
                                    "}\npictures:\n  - " + picture + "\n");
    const ToolResult result = study();
    EXPECT_EQ(result.status, 4);
    EXPECT_FALSE(fs::exists(made("")));
    return result.errors;
  };
  EXPECT_EQ(fault("strip: none", "{name: a, kind: strips}"),
            "study.yaml:5:5: for the picture 'a' the scene of run 1 has no strip; give it one with 'strip: {}'\n");
  for (const std::string kind : {"spectra", "spectrum_curves"})
    EXPECT_EQ(fault("spectrum: none", "{name: a, kind: " + kind + "}"),
              "study.yaml:5:5: for the picture 'a' the scene of run 1 has no spectrum; give it one with 'spectrum: "
              "{}'\n");
  EXPECT_EQ(fault("render.views: [textured]", "{name: a, kind: frames, times: [0], views: [velocity]}"),
            "study.yaml:5:5: for the picture 'a' the scene of run 1 has no view 'velocity'; add it to render.views\n");
  EXPECT_EQ(fault("render.views: [textured]", "{name: a, kind: strips, times: [0], views: [velocity]}"),
            "study.yaml:5:5: for the picture 'a' the scene of run 1 has no view 'velocity'; add it to render.views\n");
}

TEST_F(StudyFaults, AsksTheFirstRunOfStripsAloneForFrames) {
  const auto status = [&](const std::string& first, const std::string& second) {
    folder_.write("study.yaml",
                  "billow_study: 1\nscene: scene.yaml\nset: {duration: 0.1, render.size: [32, 24]}\n"
                  "axes: [{name: view, key: render.views, values: [[" +
                      first + "], [" + second +
                      "]]}]\n"
                      "pictures: [{name: a, kind: strips, times: [0.1], views: [textured, velocity]}]\n");
    return study({"--list"}).status;
  };
  EXPECT_EQ(status("textured", "velocity"), 0);
  EXPECT_EQ(status("velocity", "textured"), 4);
}

TEST_F(StudyFaults, LeavesOtherFoldersAlone) {
  fs::create_directory(made(""));
  folder_.write("made/letter.txt", "Dear");
  const ToolResult result = study();
  EXPECT_EQ(result.status, 6);
  EXPECT_NE(result.errors.find("already holds files that are not a study's"), std::string::npos) << result.errors;
}

TEST_F(StudyFaults, FindsAFaultBeforeTheFirstRun) {
  folder_.write("study.yaml", test::edited(plot_study, "values: [0.5, 1]", "values: [0.5, -1]"));
  const ToolResult result = study();
  EXPECT_EQ(result.status, 4);
  EXPECT_EQ(
      result.errors,
      "study.yaml:5:61: lambda is -1 per mean rest length; it must be above 0 and at most 1000 per mean rest length\n");
  EXPECT_FALSE(fs::exists(made("")));
}

}  // namespace
}  // namespace billow
