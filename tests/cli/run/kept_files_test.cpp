// What --resume keeps of an earlier run: only what is whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using test::run_tool;
using test::ToolResult;
using testing::HasSubstr;
using testing::Not;

constexpr const char* scene =
    "billow: 1\nduration: 1\n"
    "bodies:\n"
    "  - name: drape\n"
    "    cloth:\n"
    "      mesh: cloth.obj\n"
    "      transform: {scale: 0.09}\n"
    "      mass: 0.05\n"
    "      stiffness: {max_eigenvalue: 1000000}\n"
    "      pins: [{corner: top_left}]\n"
    "render: {size: [48, 32], fps: 8, samples: 1, views: [textured, velocity, depth, data]}\n";

class KeptFiles : public testing::Test {
 protected:
  KeptFiles() {
    folder_.write("cloth.obj", test::mesh_file("obj", test::quad_grid(8, 8)));
    folder_.write("scene.yaml", scene);
  }

  ToolResult run(const std::string& command, const std::string& output, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {command, "scene.yaml", "-o", output, "--progress", "plain"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments, folder_.path());
  }

  fs::path at(const std::string& file) const { return folder_.path() / file; }
  std::string bytes_of(const std::string& file) const { return test::read_text(at(file)); }
  void flip(const std::string& file, std::size_t byte) const {
    std::string bytes = bytes_of(file);
    bytes.at(byte) ^= 0x10;
    folder_.write(file, bytes);
  }
  void shorten(const std::string& file) const { folder_.write(file, bytes_of(file).substr(0, 200)); }

  // The files below these folders of `run` whose bytes are others than in `whole`.
  std::set<std::string> differing(const std::string& run, const std::string& whole,
                                  const std::vector<std::string>& folders) const {
    std::set<std::string> names;
    for (const std::string& folder : folders)
      for (const auto& entry : fs::directory_iterator(at(whole) / folder)) {
        const std::string name = folder + "/" + entry.path().filename().string();
        if (bytes_of(run + "/" + name) != bytes_of(whole + "/" + name)) names.insert(name);
      }
    return names;
  }

  test::TemporaryFolder folder_;
};

TEST_F(KeptFiles, DamagedFramesAreDrawnAgainAndOthersStay) {
  const std::vector<std::string> views = {"textured", "velocity", "depth", "data"};
  ASSERT_EQ(run("render", "film").status, 0);
  ASSERT_EQ(run("render", "small", {"-D", "render.size=[24, 16]"}).status, 0);
  fs::copy(at("film"), at("whole"), fs::copy_options::recursive);
  const std::map<std::string, std::string> faults = {
      {"textured/frame_0002.png", "is damaged: a checksum is wrong"},
      {"velocity/frame_0003.png", "is cut short"},
      {"textured/frame_0004.png", "has 24 x 16 pixels instead of 48 x 32"},
      {"depth/frame_0005.png", "is empty"},
      {"data/frame_0006.exr", "is damaged: a checksum is wrong"},
      {"data/frame_0007.exr", "is damaged: its header does not add up"}};
  flip("film/textured/frame_0002.png", bytes_of("film/textured/frame_0002.png").size() / 2);
  shorten("film/velocity/frame_0003.png");
  fs::copy_file(at("small/textured/frame_0004.png"), at("film/textured/frame_0004.png"),
                fs::copy_options::overwrite_existing);
  folder_.write("film/depth/frame_0005.png", "");
  flip("film/data/frame_0006.exr", bytes_of("film/data/frame_0006.exr").size() - 1);
  shorten("film/data/frame_0007.exr");
  ASSERT_EQ(differing("film", "whole", views).size(), faults.size());
  std::map<std::string, fs::file_time_type> times;
  for (const std::string& view : views)
    for (const auto& entry : fs::directory_iterator(at("film") / view))
      times[view + "/" + entry.path().filename().string()] = entry.last_write_time();

  const ToolResult resumed = run("render", "film", {"--resume"});
  ASSERT_EQ(resumed.status, 0) << resumed.errors;
  EXPECT_THAT(differing("film", "whole", views), testing::IsEmpty());
  for (const auto& [file, fault] : faults)
    EXPECT_THAT(resumed.errors, HasSubstr("warning: film/" + file + " " + fault + "; it is drawn again\n"));
  for (const auto& [file, time] : times)
    EXPECT_EQ(fs::last_write_time(at("film") / file) == time, !faults.contains(file)) << file;
  EXPECT_THAT(resumed.errors, HasSubstr("wrote 6 images (26 kept)"));
}

TEST_F(KeptFiles, WholeOnesAreKeptWithoutAWord) {
  ASSERT_EQ(run("render", "film").status, 0);
  const ToolResult resumed = run("render", "film", {"--resume"});
  ASSERT_EQ(resumed.status, 0) << resumed.errors;
  EXPECT_THAT(resumed.errors, HasSubstr("wrote 0 images (32 kept)"));
  EXPECT_THAT(resumed.errors, Not(HasSubstr("warning")));
}

TEST_F(KeptFiles, DamagedStatesAreSimulatedAgain) {
  ASSERT_EQ(run("simulate", "whole").status, 0);
  for (const char* file : {"frame_0002.npz", "checkpoint.npz"}) {
    fs::remove_all(at("sim"));
    fs::copy(at("whole"), at("sim"), fs::copy_options::recursive);
    flip(std::string("sim/states/") + file, 700);
    const ToolResult resumed = run("simulate", "sim", {"--resume"});
    ASSERT_EQ(resumed.status, 0) << resumed.errors;
    EXPECT_THAT(resumed.errors, HasSubstr(std::string("warning: sim/states/") + file + ": is damaged"));
    EXPECT_THAT(resumed.errors, HasSubstr("; the simulation begins again\n"));
    EXPECT_THAT(differing("sim", "whole", {"states"}), testing::IsEmpty());
  }
}

TEST_F(KeptFiles, DurableOnesAreTheSame) {
  ASSERT_EQ(run("render", "film").status, 0);
  const ToolResult durable = run("render", "durable", {"--durable"});
  ASSERT_EQ(durable.status, 0) << durable.errors;
  EXPECT_THAT(differing("durable", "film", {"textured", "data"}), testing::IsEmpty());
}

}  // namespace
}  // namespace billow
