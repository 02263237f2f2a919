// The programs that geometry caches are for read them: Blender and VTK, as Debian has them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;

const fs::path scripts = fs::path(BILLOW_SOURCE_DIR) / "tests/tools";

// A cloth of 8 x 8 quads, one metre wide, that falls from 5 cm onto the ground, a layer of 3 mm thick.
constexpr const char* falling = R"(billow: 1
duration: 0.4
bodies:
  - name: sheet
    cloth:
      mesh: sheet.{}
      transform: {{scale: 0.125, translate: [0, 0.05, 0]}}
      mass: 0.2
      stiffness: {{structural: 100, shear: 50, bend: 10}}
    contact: {{thickness: 0.002}}
colliders: [{{name: floor, plane: {{height: 0}}, thickness: 0.002}}]
render: {{size: [32, 24], fps: 25, samples: 1, views: [velocity]}}
)";

// A cloth of 9 x 9 vertices, each with texture coordinates.
std::string textured() {
  std::string text;
  for (int v = 0; v < 81; ++v)
    text += fmt::format("v {} 0 {}\nvt {} {}\n", v % 9, v / 9, v % 9 / 8.0, 1.0 - v / 9 / 8.0);
  for (int z = 0; z < 8; ++z)
    for (int x = 0; x < 8; ++x) {
      const int v = 9 * z + x + 1;
      text += fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", v, v + 9, v + 10, v + 1);
    }
  return text;
}

// The same cloth as a PLY file of two halves that share no vertex, each with texture coordinates of its own, and one
// vertex of no face between them.
std::string halves() {
  std::string vertices, faces;
  for (int half = 0; half < 2; ++half)
    for (int z = 0; z <= 8; ++z)
      for (int x = 0; x <= 4; ++x) {
        vertices += fmt::format("{} 0 {} {} {}\n", x + 4 * half, z, 0.2 * x, 1.0 - z / 8.0);
        const int v = x + 5 * z + 46 * half;
        if (x < 4 && z < 8) faces += fmt::format("4 {} {} {} {}\n", v, v + 5, v + 6, v + 1);
        if (v == 44) vertices += "4 2 4 0 0\n";
      }
  return fmt::format(
      "ply\nformat ascii 1.0\nelement vertex 91\nproperty float x\nproperty float y\nproperty float z\n"
      "property float s\nproperty float t\nelement face 64\nproperty list uchar int vertex_indices\n"
      "end_header\n{}{}",
      vertices, faces);
}

// The caches of that cloth read from a file of the given kind.
class GeometryReaders : public testing::Test {
 protected:
  fs::path caches(const std::string& extension, const std::string& mesh, const std::string& formats) {
    folder_.write("sheet." + extension, mesh);
    folder_.write("scene.yaml", fmt::format(falling, extension));
    const test::ToolResult result =
        test::run_tool({"render", "scene.yaml", "-o", "film", "--cache", formats, "--overwrite"}, folder_.path());
    EXPECT_EQ(result.status, 0) << result.errors;
    return folder_.path() / "film/caches";
  }

  void expect_blender_reads(const fs::path& caches, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"-b",
                                       "--factory-startup",
                                       "--python-exit-code",
                                       "1",
                                       "--python",
                                       scripts / "read_in_blender.py",
                                       "--",
                                       caches,
                                       "sheet",
                                       "10"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::ToolResult result = test::run_program("blender", arguments, folder_.path());
    EXPECT_EQ(result.status, 0) << result.output << result.errors;
    EXPECT_NE(result.output.find("largest difference"), std::string::npos) << result.output;
  }

  test::TemporaryFolder folder_;
};

TEST_F(GeometryReaders, BlenderPlaysPointCachesOnTheRestMesh) {
  expect_blender_reads(caches("obj", textured(), "pc2,mdd,obj"));
}

TEST_F(GeometryReaders, BlenderPlaysThemOnAMeshWithSeams) {
  expect_blender_reads(caches("ply", halves(), "pc2,mdd,obj"), {"legacy"});
}

TEST_F(GeometryReaders, VtkReadsTheCollection) {
  const fs::path folder = caches("obj", textured(), "vtp,pc2");
  const test::ToolResult result = test::run_program(
      "/usr/bin/python3", {scripts / "read_in_vtk.py", folder, "sheet", "25", "0.0045"}, folder_.path());
  EXPECT_EQ(result.status, 0) << result.output << result.errors;
}

}  // namespace
}  // namespace billow
