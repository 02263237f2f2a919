// The smaller commands from outside.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

using test::run_tool;
using test::ToolResult;
using Json = nlohmann::json;

class Commands : public testing::Test {
 protected:
  Commands() { folder_.scene(test::base_scene); }
  ToolResult run(std::vector<std::string> arguments) { return run_tool(arguments, folder_.path()); }

  test::SceneFolder folder_;
};

TEST_F(Commands, HelpAndVersionSucceed) {
  EXPECT_EQ(run({"--help"}).status, 0);
  EXPECT_EQ(run({"render", "--help"}).status, 0);
  const ToolResult version = run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.output.rfind("billow ", 0), 0u) << version.output;
  EXPECT_EQ(run({}).status, 2);
}

TEST_F(Commands, VersionAsJsonSaysWhatTheBuildWasMadeOf) {
  const ToolResult result = run({"--version", "--json"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const Json facts = Json::parse(result.output);
  EXPECT_EQ("billow " + facts["billow"].get<std::string>() + "\n", run({"--version"}).output);
  EXPECT_TRUE(facts["commit"].is_null() || facts["commit"].get<std::string>().size() >= 40) << facts["commit"];
  EXPECT_EQ(facts["dirty"].is_boolean(), facts["commit"].is_string()) << facts["dirty"];
  EXPECT_THAT(facts["compiler"].get<std::string>(), testing::MatchesRegex("(gcc|clang) [0-9]+\\.[0-9]+\\.[0-9]+"));
  for (const char* library : {"Eigen", "assimp", "libpng", "yaml-cpp", "OpenEXR"})
    EXPECT_THAT(facts["libraries"][library].get<std::string>(), testing::MatchesRegex("[0-9]+\\.[0-9].*")) << library;
  for (const auto& [library, version] : facts["libraries"].items()) EXPECT_FALSE(version.is_null()) << library;
  EXPECT_THAT(facts["instruction_sets"]["compiled"], testing::Contains(facts["instruction_sets"]["chosen"]));
  EXPECT_EQ(run({"--json", "--version"}).output, result.output);
  const ToolResult alone = run({"--json", "doctor"});
  EXPECT_EQ(alone.status, 2);
  EXPECT_EQ(alone.output, "");
}

TEST_F(Commands, NamesTheOneThatWasMeant) {
  const ToolResult result = run({"stabilty", "scene.yaml"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.errors, "unknown command 'stabilty'; did you mean 'stability'?\n");
}

TEST_F(Commands, CheckPrintsASceneThatChecksAgain) {
  const ToolResult first = run({"check", "scene.yaml"});
  ASSERT_EQ(first.status, 0) << first.errors;
  folder_.write("effective.yaml", first.output);
  const ToolResult second = run({"check", "effective.yaml"});
  ASSERT_EQ(second.status, 0) << second.errors;
  EXPECT_EQ(second.output, first.output);
}

TEST_F(Commands, CheckLocatesAFault) {
  const ToolResult result = run({"check", "scene.yaml", "-D", "solver.step=-1"});
  EXPECT_EQ(result.status, 4);
  EXPECT_EQ(result.errors.rfind("-D solver.step: ", 0), 0u) << result.errors;
  EXPECT_EQ(run({"check", "nowhere.yaml"}).status, 4);
}

TEST_F(Commands, RefuseTimesAndMaterialsWithoutAnEnd) {
  EXPECT_EQ(run({"stability", "scene.yaml", "--at", "nan"}).status, 2);
  EXPECT_LE(run({"check", "scene.yaml", "-D", "bodies.0.cloth.stiffness={structural: 1e-300}"}).status, 4);
  EXPECT_LE(run({"check", "scene.yaml", "-D", "bodies.0.cloth.mass=1e-310"}).status, 4);
}

TEST_F(Commands, StructureListsParticlesAndSprings) {
  const ToolResult result = run({"structure", "scene.yaml", "--json"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const Json json = Json::parse(result.output);
  EXPECT_EQ(json["particles"].size(), 9u);
  EXPECT_EQ(json["springs"].size(), 12u + 8u + 6u);
  const Json spring = json["springs"][0];
  for (const char* key : {"i", "j", "rest_length", "stiffness", "kind"}) EXPECT_TRUE(spring.contains(key)) << key;
  EXPECT_LT(spring["i"], spring["j"]);
  EXPECT_EQ(run({"structure", "scene.yaml"}).status, 0);
}

TEST_F(Commands, StabilityGivesEveryMethodsLimits) {
  const ToolResult result = run({"stability", "scene.yaml", "--json", "-D",
                                 "solver={method: fb_euler, filter: {target: force, form: conserving}}"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const Json json = Json::parse(result.output);
  EXPECT_GT(json["k0"], 0.0);
  ASSERT_EQ(json["limits"].size(), 6u + 4u);
  for (const Json& limit : json["limits"])
    if (limit["method"] == "fb_euler") {
      const double paper = limit["paper"], certified = limit["certified"];
      EXPECT_NEAR(certified, paper, 0.01 * paper) << limit;
    }
}

TEST_F(Commands, CompareTellsEqualFromDifferent) {
  const std::string size = "render={size: [64, 48], fps: 10, views: [textured]}";
  ASSERT_EQ(run({"render", "scene.yaml", "-D", "duration=0.2", "-D", size, "-o", "a", "--progress", "none"}).status, 0);
  ASSERT_EQ(run({"render", "scene.yaml", "-D", "duration=0.2", "-D", size, "-o", "b", "--progress", "none"}).status, 0);
  EXPECT_EQ(run({"compare", "a", "b"}).status, 0);
  const ToolResult different =
      run({"compare", "a/textured/frame_0001.png", "a/textured/frame_0002.png", "--json", "--diff", "difference.png"});
  EXPECT_EQ(different.status, 3);
  EXPECT_EQ(Json::parse(different.output)["same"], false);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "difference.png"));
  std::filesystem::remove(folder_.path() / "b/textured/frame_0002.png");
  EXPECT_EQ(run({"compare", "a", "b"}).status, 3);
  EXPECT_EQ(run({"compare", "a", "nowhere"}).status, 4);
  EXPECT_EQ(run({"compare", "a", "scene.yaml"}).status, 4);
}

TEST_F(Commands, ProgressNoneLeavesErrorsAlone) {
  const std::string size = "render.size=[32, 24]";
  const ToolResult good =
      run({"render", "scene.yaml", "-D", "duration=0.1", "-D", size, "-o", "quiet", "--progress", "none"});
  EXPECT_EQ(good.status, 0);
  EXPECT_EQ(good.output + good.errors, "");
  const ToolResult bad = run({"render", "scene.yaml", "-o", "quiet", "--progress", "none"});
  EXPECT_EQ(bad.status, 6);
  EXPECT_NE(bad.errors.find("already holds files"), std::string::npos) << bad.errors;
}

TEST_F(Commands, HelpListsWords) {
  EXPECT_NE(run({"render", "--help"}).output.find("auto, plain, json or none"), std::string::npos);
  EXPECT_EQ(run({"render", "--help"}).output.find("->"), std::string::npos);
  const ToolResult wrong = run({"render", "scene.yaml", "--progress", "jsn"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.errors.find("there is no 'jsn'; did you mean 'json'?"), std::string::npos) << wrong.errors;
}

TEST_F(Commands, HelpOfEveryCommandListsWords) {
  const std::string help = run({"--help-all"}).output;
  EXPECT_NE(help.find("Differences that edges"), std::string::npos);
  EXPECT_EQ(help.find("->"), std::string::npos);
}

TEST_F(Commands, ErrorsAreJsonWhereProgressIs) {
  const auto error = [&](std::vector<std::string> arguments) {
    const std::string errors = run(arguments).errors;
    EXPECT_EQ(errors.find('\n'), errors.size() - 1) << errors;
    return Json::parse(errors);
  };
  folder_.write("slip.yaml", "billow: 1\nbodees: []\n");
  EXPECT_EQ(error({"check", "slip.yaml", "--progress", "json"}), (Json{{"file", "slip.yaml"},
                                                                       {"line", 2},
                                                                       {"column", 1},
                                                                       {"message", "unknown key 'bodees' in the scene"},
                                                                       {"hint", "did you mean 'bodies'?"},
                                                                       {"exit", 4}}));
  EXPECT_EQ(error({"render", "nowhere.yaml", "--progress=json"})["file"], "nowhere.yaml");
  EXPECT_EQ(error({"check", "--progress", "json"})["exit"], 2);
  EXPECT_EQ(error({"chek", "x", "--progress", "json"})["hint"], "did you mean 'check'?");
  const Json wrong = error({"render", "scene.yaml", "--backend", "elg", "--progress", "json"});
  EXPECT_TRUE(wrong["file"].is_null());
  EXPECT_EQ(wrong["hint"], "did you mean 'egl'?");
  EXPECT_EQ(error({"sheet", "nowhere", "--progress", "json"})["file"], "nowhere/run.json");
}

TEST_F(Commands, AllButDoctorSayWhatTheySayAsProgressHasIt) {
  for (const char* command : {"render", "simulate", "check", "mesh", "structure", "stability", "filter", "study",
                              "compare", "golden", "video", "sheet"})
    EXPECT_NE(run({command, "--help"}).output.find("--progress"), std::string::npos) << command;
  folder_.write("study.yaml",
                "billow_study: 1\nscene: scene.yaml\nset: {duration: 0.02}\nmeasure: {render: false}\n"
                "axes: [{name: method, key: solver.method, values: [verlet, rk4]}]\npictures: [{name: k0, kind: plot, "
                "x: method, y: k0}]\n");
  const ToolResult silent = run({"study", "study.yaml", "--jobs", "1", "--progress", "none"});
  EXPECT_EQ(silent.status, 0);
  EXPECT_EQ(silent.errors, "");
  const ToolResult said = run({"study", "study.yaml", "--jobs", "1", "--overwrite", "--progress", "json"});
  std::istringstream lines(said.errors);
  std::vector<Json> ended;
  for (std::string line; std::getline(lines, line);)
    if (const Json json = Json::parse(line); json.contains("stage")) ended.push_back(json);
  ASSERT_EQ(ended.size(), 2u) << said.errors;
  EXPECT_EQ(ended[1]["stage"], "runs");
  EXPECT_EQ(ended[1]["done"], 2);
  EXPECT_EQ(ended[1]["total"], 2);
  EXPECT_EQ(ended[1]["name"], "run 2, rk4");
  EXPECT_EQ(ended[1]["status"], "done");
}

TEST_F(Commands, SayWhatIsLeftOfTheArguments) {
  EXPECT_EQ(run({"compare", "a", "b", "--reprot", "c"}).errors,
            "billow compare does not take '--reprot', 'c'; did you mean '--report'?\n");
  EXPECT_EQ(run({"check", "a", "b"}).errors,
            "billow check does not take 'b'; 'billow check --help' lists what it takes\n");
  EXPECT_EQ(run({"check", "a", "b"}).status, 2);
  EXPECT_EQ(run({"check", "--", "a", "--progress"}).errors,
            "billow check does not take '--progress'; what stands behind '--' is no option\n");
}

TEST_F(Commands, WriteNoFileThatLooksLikeStandardOutput) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"compare", "a", "b", "--junit", "-"},
                                                    {"compare", "a", "b", "--diff", "-"},
                                                    {"golden", "a", "--junit", "-"},
                                                    {"sheet", "a", "-o", "-"}}) {
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.errors.find("'-' is standard output, where this is not written; give it a name"),
              std::string::npos)
        << result.errors;
  }
}

TEST_F(Commands, ReadASceneFromStandardInput) {
  const auto shell = [&](const std::string& line) {
    return test::run_program("bash", {"-c", line, BILLOW_TOOL}, folder_.path());
  };
  const ToolResult good = shell("\"$0\" check - < scene.yaml");
  EXPECT_EQ(good.status, 0) << good.errors;
  EXPECT_EQ(good.output, run({"check", "scene.yaml"}).output);
  EXPECT_EQ(good.errors.find("<stdin>: good."), 0u) << good.errors;
  EXPECT_EQ(shell("echo 'bodees: 1' | \"$0\" check -").errors.find("<stdin>:1:1: "), 0u);
  EXPECT_EQ(shell("\"$0\" stability - < scene.yaml").output, run({"stability", "scene.yaml"}).output);
  const ToolResult run_of_none = shell("\"$0\" render - < scene.yaml");
  EXPECT_EQ(run_of_none.status, 2);
  EXPECT_NE(run_of_none.errors.find("save the scene as a file"), std::string::npos) << run_of_none.errors;
}

TEST_F(Commands, SayWhatToDoWithAPipe) {
  const ToolResult result =
      test::run_program("bash", {"-c", "\"$0\" check <(cat scene.yaml)", BILLOW_TOOL}, folder_.path());
  EXPECT_EQ(result.status, 4);
  EXPECT_NE(
      result.errors.find("this is a pipe, not a file; save what comes through it as one, or have 'billow check -'"),
      std::string::npos)
      << result.errors;
}

TEST_F(Commands, DoctorSaysWhatIsMissingAndWhatThatCosts) {
  const ToolResult found = run({"doctor"});
  EXPECT_NE(found.output.find("gnuplot       found"), std::string::npos) << found.output;
  EXPECT_EQ(found.output.find(" \n"), std::string::npos) << "a line ends with a space";
  const Json built = Json::parse(run({"--version", "--json"}).output);
  EXPECT_THAT(found.output, testing::HasSubstr("compiler      " + built["compiler"].get<std::string>() + "\n"));
  for (const auto& [library, version] : built["libraries"].items())
    EXPECT_THAT(found.output, testing::HasSubstr(fmt::format("{:<13} {}", library, version.get<std::string>())));
  const ToolResult bare = test::run_program("env", {"PATH=/nowhere", BILLOW_TOOL, "doctor"}, folder_.path());
  EXPECT_NE(bare.output.find("missing: plots of 'study' and 'filter' are not drawn"), std::string::npos);
  EXPECT_NE(bare.output.find("missing: 'video' makes no film"), std::string::npos);
}

TEST_F(Commands, DoctorFindsTheRenderer) {
  const ToolResult result = run({"doctor"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_NE(result.output.find("llvmpipe"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace billow
