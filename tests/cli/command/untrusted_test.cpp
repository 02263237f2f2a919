// Scenes, studies and meshes of strangers: which files are read, and what of them is shown.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using test::ToolResult;
using testing::HasSubstr;
using testing::Not;

const std::string secret = "root:x:0:0:s3cret\n";

/// job/scene.yaml and job/study.yaml, beside what is not theirs.
class Untrusted : public testing::Test {
 protected:
  Untrusted() {
    write("job/cloth.obj", test::read_text(folder_.path() / "cloth.obj"));
    write("job/scene.yaml", test::base_scene);
    write("job/study.yaml", study_of("scene.yaml"));
    write("other/scene.yaml", test::base_scene);
    for (const char* name : {"other/passwd", "other/passwd.obj", "other/passwd.ply", "other/passwd.off"})
      write(name, secret);
  }
  static std::string study_of(const std::string& scene) {
    return "billow_study: 1\nscene: " + scene +
           "\nmeasure: {render: false}\npictures: [{name: p, kind: plot, x: k0, y: k0}]\n";
  }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_.path() / name).parent_path());
    folder_.write(name, text);
  }
  ToolResult run(std::vector<std::string> arguments) const { return test::run_tool(arguments, folder_.path()); }

  test::SceneFolder folder_;
};

TEST_F(Untrusted, ScenesReadWhatIsInTheirFolderAlone) {
  EXPECT_EQ(run({"check", "job/scene.yaml", "--untrusted"}).status, 0);
  for (const char* key : {"bodies.0.cloth.mesh", "bodies.0.texture"}) {
    const ToolResult result = run({"check", "job/scene.yaml", "--untrusted", "-D", std::string(key) + "=../cloth.obj"});
    EXPECT_EQ(result.status, 4);
    EXPECT_THAT(result.errors, HasSubstr("cloth.obj is outside, and with --untrusted"));
  }
  EXPECT_EQ(run({"check", "job/scene.yaml", "-D", "bodies.0.cloth.mesh=../cloth.obj"}).status, 0);
}

TEST_F(Untrusted, StudiesAndTheirRunsAreHeldToItToo) {
  EXPECT_EQ(run({"study", "job/study.yaml", "--untrusted", "-o", "made"}).status, 0);
  write("job/study.yaml", study_of("../other/scene.yaml"));
  const ToolResult result = run({"study", "job/study.yaml", "--untrusted", "--list"});
  EXPECT_EQ(result.status, 4);
  EXPECT_THAT(result.errors, HasSubstr("job/study.yaml:2:8: other/scene.yaml is outside, and with --untrusted"));
}

TEST_F(Untrusted, AStudyShowsNothingOfAFileThatIsNoScene) {
  write("job/study.yaml", study_of("../other/passwd"));
  const ToolResult result = run({"study", "job/study.yaml", "--list"});
  EXPECT_EQ(result.status, 4);
  EXPECT_EQ(result.errors, "job/study.yaml:2:8: other/passwd is no scene file; 'billow check other/passwd' says why\n");
}

TEST_F(Untrusted, ASceneShowsNothingOfAFileThatIsNoMesh) {
  fs::create_symlink("../other/passwd", folder_.path() / "job/link.obj");
  for (const char* mesh : {"../other/passwd.obj", "../other/passwd.ply", "../other/passwd.off", "link.obj"}) {
    const ToolResult result = run({"check", "job/scene.yaml", "-D", std::string("bodies.0.cloth.mesh=") + mesh});
    EXPECT_EQ(result.status, 4) << mesh;
    EXPECT_THAT(result.errors, Not(HasSubstr("s3cret"))) << mesh;
    EXPECT_THAT(result.errors, HasSubstr("says why")) << mesh;
  }
}

// The user who names it sees why it is no mesh.
TEST_F(Untrusted, TheNamedFileIsQuoted) {
  for (const char* name : {"other/words.obj", "job/words.obj"}) write(name, "v s3cret 0 0\n");
  EXPECT_THAT(run({"mesh", "other/words.obj"}).errors, HasSubstr("s3cret"));
  EXPECT_THAT(run({"check", "job/scene.yaml", "-D", "bodies.0.cloth.mesh=words.obj"}).errors, HasSubstr("s3cret"));
}

TEST_F(Untrusted, NamesReachTheTerminalAsText) {
  const std::string odd = "a\x1b[31m\u202e\u009b\r\xff日";
  const std::string written = "a\\x1b[31m\\u202e\\u009b\\r\\xff日";
  write(odd + ".obj",
        "mtllib " + odd + "\n" + odd + "x 1\ng " + odd + "\n" + test::read_text(folder_.path() / "cloth.obj"));
  EXPECT_THAT(run({"mesh", odd + ".obj"}).output, HasSubstr(written + ".obj: 9 vertices"));
  EXPECT_EQ(run({"check", odd}).errors, written + ": no such file\n");
  EXPECT_THAT(run({"check", "job/scene.yaml", "--" + odd}).errors, HasSubstr("--" + written));
  EXPECT_THAT(run({odd}).errors, HasSubstr("unknown command '" + written + "'"));
  const ToolResult json = run({"mesh", odd + ".obj", "--json"});
  EXPECT_THAT(json.output, HasSubstr("\\u202e"));
  EXPECT_TRUE(nlohmann::json::accept(json.output)) << json.output;
}

TEST_F(Untrusted, ThePrintedSceneReadsBackWhateverItsNames) {
  write("job/scene.yaml", test::edited(test::base_scene, "name: sheet", "name: \"\\u202e\\u200b日\""));
  const ToolResult first = run({"check", "job/scene.yaml"});
  ASSERT_EQ(first.status, 0) << first.errors;
  EXPECT_THAT(first.output, HasSubstr("name: \"\\u202e\\u200b日\""));
  write("job/again.yaml", first.output);
  EXPECT_EQ(run({"check", "job/again.yaml"}).output, first.output);
}

}  // namespace
}  // namespace billow
