// Links in the folder of a run: nothing outside of it is written or removed.
#include <gmock/gmock.h>

#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using test::ToolResult;
using testing::HasSubstr;

class OutputLinks : public testing::Test {
 protected:
  OutputLinks() {
    folder_.scene(test::base_scene);
    for (const char* name : {"frame_0001.png", "cloth.pc2", "states.json", "scene.glb", "log.txt"})
      folder_.write(std::string("outside/") + name, "mine");
  }
  ToolResult run(const std::string& command, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {command, "scene.yaml", "-o", "out", "-D", "duration=0.1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_tool(arguments, folder_.path());
  }
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  void link(const std::string& name, const std::string& target) const {
    fs::create_directories(path(name).parent_path());
    fs::remove_all(path(name));
    fs::create_symlink(path(target), path(name));
  }
  void expect_untouched() const {
    EXPECT_EQ(std::distance(fs::directory_iterator(path("outside")), {}), 5);
    for (const auto& entry : fs::directory_iterator(path("outside")))
      EXPECT_EQ(test::read_text(entry.path()), "mine") << entry.path();
  }

  test::SceneFolder folder_;
};

TEST_F(OutputLinks, OfFoldersAreRefusedBeforeAnythingIsDone) {
  for (const char* name : {"textured", "depth", "caches", "states"}) {
    SCOPED_TRACE(name);
    fs::remove_all(path("out"));
    ASSERT_EQ(run("render", {"--cache", "glb"}).status, 0);
    link(std::string("out/") + name, "outside");
    for (const char* mode : {"--overwrite", "--resume"}) {
      const ToolResult result = run("render", {mode, "--cache", "glb"});
      EXPECT_EQ(result.status, 6);
      EXPECT_THAT(result.errors,
                  HasSubstr(std::string("out/") + name + " is a link, and nothing is written through it"));
    }
    expect_untouched();
  }
}

TEST_F(OutputLinks, OfACachesFramesAreRefused) {
  link("out/caches/sheet", "outside");
  const ToolResult result = run("render", {"--overwrite", "--cache", "obj"});
  EXPECT_EQ(result.status, 6);
  EXPECT_THAT(result.errors, HasSubstr("out/caches/sheet is a link"));
  expect_untouched();
}

TEST_F(OutputLinks, OfFilesAreReplacedByTheFile) {
  ASSERT_EQ(run("render", {}).status, 0);
  for (const char* name : {"run.json", "index.html", "textured/frame_0001.png"})
    link(std::string("out/") + name, "outside/log.txt");
  EXPECT_EQ(run("render", {"--overwrite"}).status, 0);
  EXPECT_FALSE(fs::is_symlink(path("out/textured/frame_0001.png")));
  expect_untouched();
}

TEST_F(OutputLinks, OfAStudysLogsAndRunsAreNotFollowed) {
  folder_.write("study.yaml",
                "billow_study: 1\nscene: scene.yaml\nset: {duration: 0.1}\nmeasure: {render: false}\n"
                "pictures: [{name: p, kind: plot, x: k0, y: k0}]\n");
  const std::vector<std::string> study = {"study", "study.yaml", "-o", "made", "--overwrite"};
  link("made/runs/001/log.txt", "outside/log.txt");
  link("made/p.png.drawing", "outside/log.txt");
  EXPECT_EQ(test::run_tool(study, folder_.path()).status, 0);
  EXPECT_FALSE(fs::is_symlink(path("made/runs/001/log.txt")));
  expect_untouched();
  link("made/runs/001", "outside");
  const ToolResult result = test::run_tool(study, folder_.path());
  EXPECT_EQ(result.status, 6);
  EXPECT_THAT(result.errors, HasSubstr("made/runs/001 is a link, and nothing is written through it"));
  expect_untouched();
}

// The folder that -o names may be a link: the user has named it.
TEST_F(OutputLinks, MayBeTheNamedFolderItself) {
  fs::create_directory(path("elsewhere"));
  link("out", "elsewhere");
  EXPECT_EQ(run("render", {}).status, 0);
  EXPECT_EQ(run("render", {"--overwrite"}).status, 0);
  EXPECT_TRUE(fs::is_regular_file(path("elsewhere/run.json")));
}

}  // namespace
}  // namespace billow
