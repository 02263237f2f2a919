// Geometry caches of whole runs: which files, of which frames, with which bytes.
#include <fmt/format.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;

// A sheet and a fish over a turning box, six frames, seen by a camera that stays beside the fish.
constexpr const char* three = R"(billow: 1
duration: 0.24
bodies:
  - name: sheet
    cloth: {mesh: sheet.ply, transform: {scale: 0.1}, mass: 0.1, stiffness: {structural: 100, shear: 50, bend: 10}}
  - name: carp
    fish: {position: [0, 3, 0]}
colliders:
  - name: a&b
    box: {size: [0.2, 0.2, 0.2], centre: [0.4, -0.2, 0.4]}
    motion: [{time: 0}, {time: 1, rotate: [0, 90, 0]}]
render: {size: [32, 24], fps: 25, samples: 1, views: [velocity], camera: {follow: carp}}
)";

class Caches : public testing::Test {
 protected:
  Caches() {
    folder_.write("sheet.ply", test::mesh_file("ply", test::quad_grid(9, 9)));
    folder_.write("scene.yaml", three);
  }

  test::ToolResult render(std::vector<std::string> more) {
    std::vector<std::string> arguments{"render", "scene.yaml", "-o", "film", "--cache", "pc2,mdd,obj,ply,vtp"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_tool(arguments, folder_.path());
  }

  fs::path film(const std::string& file = "") const { return folder_.path() / "film" / file; }

  std::map<std::string, std::string> cached() const {
    std::map<std::string, std::string> bytes;
    for (const auto& entry : fs::recursive_directory_iterator(film("caches")))
      if (entry.is_regular_file()) bytes[fs::relative(entry, film("caches"))] = test::read_text(entry.path());
    return bytes;
  }

  test::TemporaryFolder folder_;
};

TEST_F(Caches, AreOfEverythingAndListed) {
  const test::ToolResult result = render({});
  ASSERT_EQ(result.status, 0) << result.errors;
  const auto files = cached();
  EXPECT_EQ(files.size(), 3u * (4 + 3 * 6));  // pc2, mdd, pvd, rest.obj; obj, ply and vtp of six frames
  const auto listed = nlohmann::json::parse(test::read_text(film("run.json")))["caches"];
  ASSERT_EQ(listed.size(), 15u);
  for (const auto& cache : listed) {
    EXPECT_TRUE(fs::exists(film(cache["file"]))) << cache;
    EXPECT_EQ(cache["frames"], 6) << cache;
  }
  EXPECT_EQ(listed[0]["vertices"], 81);
  EXPECT_NE(test::read_text(film("index.html")).find("caches/carp.pc2"), std::string::npos);
  EXPECT_EQ(files.at("sheet.rest.obj"), files.at("sheet/frame_0001.obj"));
}

TEST_F(Caches, AreTheSameForAnyNumberOfThreads) {
  ASSERT_EQ(render({"--threads", "1"}).status, 0);
  const auto one = cached();
  ASSERT_EQ(render({"--threads", "2", "--overwrite"}).status, 0);
  EXPECT_EQ(cached(), one);
}

// Frames are numbered as the pictures are, and what they hold does not depend on which are asked for.
TEST_F(Caches, OfSomeFramesAreThoseOfAll) {
  ASSERT_EQ(render({}).status, 0);
  const auto all = cached();
  ASSERT_EQ(render({"--frames", "3-4", "--overwrite"}).status, 0);
  const auto some = cached();
  EXPECT_EQ(some.size(), 3u * (4 + 3 * 2));
  for (const auto& [file, bytes] : some)
    if (file.find("frame_") != file.npos) {
      EXPECT_EQ(bytes, all.at(file)) << file;
    }
  const std::string cut = all.at("carp.pc2").substr(32 + 2 * 12 * 23, 2 * 12 * 23);
  EXPECT_EQ(some.at("carp.pc2").substr(32), cut);
}

TEST_F(Caches, GoWithTheRunThatWroteThem) {
  ASSERT_EQ(render({}).status, 0);
  const auto before = cached();
  std::ofstream(film("caches/notes.txt")) << "mine";
  fs::remove(film("caches/sheet.pc2"));
  ASSERT_EQ(render({"--resume"}).status, 0);
  EXPECT_EQ(cached().at("sheet.pc2"), before.at("sheet.pc2"));
  ASSERT_EQ(test::run_tool({"render", "scene.yaml", "-o", "film", "--overwrite"}, folder_.path()).status, 0);
  EXPECT_THAT(cached(), testing::ElementsAre(testing::Pair("notes.txt", "mine")));
}

TEST_F(Caches, ThatCannotBeWrittenEndTheRun) {
  fs::create_directories(film("caches/sheet.pc2/in the way"));
  const test::ToolResult result = render({"--overwrite"});
  EXPECT_EQ(result.status, 6);
  EXPECT_NE(result.errors.find("sheet.pc2: it exists and is not a file"), std::string::npos) << result.errors;
}

}  // namespace
}  // namespace billow
