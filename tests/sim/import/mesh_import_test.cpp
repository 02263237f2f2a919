// Mesh files: what is read from them, and what is said of those that cannot be read.
#include "sim/import/mesh_import.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cstring>

#include "base/error.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

using test::mesh_file;
using test::quad_grid;
using test::TemporaryFolder;
using test::triangulated;
using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const std::filesystem::path& file, const ImportLimits& limits = {}) {
  try {
    import_mesh(file, limits);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

// ---- what is read ----

class EveryFormat : public testing::TestWithParam<const char*> {
 protected:
  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(MeshImport, EveryFormat, testing::Values("obj", "off", "ply", "stl", "gltf", "glb"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(EveryFormat, ReadsTheSameTriangles) {
  const Mesh grid = triangulated(quad_grid(6, 5));
  const Mesh mesh = import_mesh(folder_.write(std::string("grid.") + GetParam(), mesh_file(GetParam(), grid)));
  ASSERT_EQ(mesh.vertices(), 30);
  ASSERT_EQ(mesh.face.size(), grid.face.size());
  for (std::size_t f = 0; f < grid.face.size(); ++f)
    for (int c = 0; c < 3; ++c)
      EXPECT_TRUE(mesh.position.row(mesh.face[f][c]).isApprox(grid.position.row(grid.face[f][c])));
}

// Users pin vertices by number, so the file's numbers must stay. STL has none.
TEST_P(EveryFormat, KeepsTheFilesNumbering) {
  if (std::string_view(GetParam()) == "stl") GTEST_SKIP();
  Mesh grid = triangulated(quad_grid(6, 5));
  std::reverse(grid.face.begin(), grid.face.end());
  const Mesh mesh = import_mesh(folder_.write(std::string("grid.") + GetParam(), mesh_file(GetParam(), grid)));
  EXPECT_TRUE(mesh.position.isApprox(grid.position));
  EXPECT_EQ(mesh.face, grid.face);
}

TEST_P(EveryFormat, IsRecognisedInUpperCase) {
  std::string name = std::string("GRID.") + GetParam();
  std::transform(name.begin(), name.end(), name.begin(), toupper);
  EXPECT_EQ(import_mesh(folder_.write(name, mesh_file(GetParam(), triangulated(quad_grid(2, 2))))).vertices(), 4);
}

TEST(MeshImport, KeepsQuads) {
  const TemporaryFolder folder;
  const Mesh grid = quad_grid(6, 5);
  for (const char* extension : {"obj", "off", "ply"}) {
    SCOPED_TRACE(extension);
    const Mesh mesh = import_mesh(folder.write(std::string("grid.") + extension, mesh_file(extension, grid)));
    EXPECT_EQ(mesh.face, grid.face);
    EXPECT_TRUE(mesh.position.isApprox(grid.position));
  }
}

TEST(MeshImport, CutsLargerPolygonsIntoFansAndSkipsLines) {
  const TemporaryFolder folder;
  const Mesh mesh =
      import_mesh(folder.write("pentagon.obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 2 0\nv -1 1 0\nl 1 2\nf 1 2 3 4 5\n"));
  EXPECT_THAT(mesh.face, ElementsAre(Face{0, 1, 2, -1}, Face{0, 2, 3, -1}, Face{0, 3, 4, -1}));
}

TEST(MeshImport, ReadsTextureCoordinatesWithVUpAndJoinsTheirSeam) {
  const TemporaryFolder folder;
  const Mesh mesh = import_mesh(folder.write("seam.obj",
                                             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
                                             "vt 0 0.25\nvt 1 0.25\nvt 1 1\nvt 0 1\n"
                                             "f 1/1 2/2 3/3 4/4\nf 2/1 5/2 6/3 3/4\n"));
  EXPECT_EQ(mesh.vertices(), 6);
  EXPECT_EQ(mesh.uv[0][1], Eigen::Vector2f(1, 0.25f));
  EXPECT_EQ(mesh.uv[1][0], Eigen::Vector2f(0, 0.25f));
}

TEST(MeshImport, ReadsColoursFromPly) {
  const TemporaryFolder folder;
  const Mesh mesh = import_mesh(folder.write(
      "colour.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 51 255\n3 0 1 2\n"));
  ASSERT_EQ(mesh.colour.rows(), 3);
  EXPECT_TRUE(mesh.colour.row(2).isApprox(Eigen::RowVector3f(0, 0.2f, 1)));
}

TEST(MeshImport, ReadsGroupsObjectsAndMaterialsOfAnObj) {
  const TemporaryFolder folder;
  const Mesh mesh =
      import_mesh(folder.write("groups.obj",
                               "mtllib nowhere.mtl\no cloth\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n"
                               "g left hem\nusemtl linen\nf 1 2 3 4\ng right\nusemtl silk\nf 2 5 3\n"));
  EXPECT_THAT(mesh.group.at("cloth"), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(mesh.group.at("left"), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(mesh.group.at("hem"), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(mesh.group.at("right"), ElementsAre(1, 2, 4));
  EXPECT_THAT(mesh.group.at("linen"), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(mesh.group.at("silk"), ElementsAre(1, 2, 4));
  EXPECT_THAT(mesh.group.at("left hem"), ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(mesh.group.size(), 7u) << "names that nobody gave are no groups";
}

TEST(MeshImport, AppliesNodeTransformsAndNamesGroupsAfterNodes) {
  const TemporaryFolder folder;
  std::string text = mesh_file("gltf", triangulated(quad_grid(2, 2)));
  const std::string node = R"("name":"Cloth")";
  text.insert(text.find(node), R"("translation":[10,0,0],"scale":[-2,2,2],)");
  const Mesh mesh = import_mesh(folder.write("moved.gltf", text));
  EXPECT_EQ(mesh.position.col(0).minCoeff(), 8.0);
  EXPECT_EQ(mesh.position.col(0).maxCoeff(), 10.0);
  const auto corner = [&](int c) -> Eigen::Vector3d { return mesh.position.row(mesh.face[0][c]); };
  EXPECT_GT((corner(1) - corner(0)).cross(corner(2) - corner(0)).y(), 0.0) << "a mirror must not turn faces over";
}

TEST(MeshImport, ReadsNumbersAsObjMayWriteThem) {
  const TemporaryFolder folder;
  const Mesh mesh = import_mesh(folder.write(
      "odd.obj", "# comment, with a comma\r\nv +1e0 0 \\\r\n0\r\nv 0 0 0\r\nv 0 2 0 2 # halved\r\nf -3 -2 -1\r\n"));
  EXPECT_EQ(mesh.position, (Eigen::MatrixX3d(3, 3) << 1, 0, 0, 0, 0, 0, 0, 1, 0).finished());
}

// ---- what is said ----

TEST(MeshImport, NamesFilesThatCannotBeMeshes) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      refusal(folder.path() / "none.obj"),
      fmt::format("cannot read mesh {}: there is no such file; check the path", (folder.path() / "none.obj").string()));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("it is a folder"));
  EXPECT_THAT(refusal(folder.write("empty.obj", "")), HasSubstr("it is empty"));
  EXPECT_THAT(refusal(folder.write("cloth.fbx", "x")),
              HasSubstr("its extension '.fbx' is none of .obj .off .stl .ply .gltf .glb"));
  EXPECT_THAT(refusal(folder.write("cloth", "x")), HasSubstr("no extension"));
  EXPECT_THAT(refusal(folder.write("large.obj", "v 0 0 0\n"), {.max_file_bytes = 4}), HasSubstr("the limit is 4"));
  const std::filesystem::path pipe = folder.path() / "pipe.obj";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refusal(pipe), HasSubstr("not a plain file"));
}

TEST(MeshImport, LocatesFaultsOfAnObj) {
  const TemporaryFolder folder;
  const auto obj = [&](const char* text) { return refusal(folder.write("bad.obj", text)); };
  EXPECT_THAT(obj("v 0 0 0\nv 1,5 0 0\n"), HasSubstr("line 2: '1,5' is not a number; write decimals with a point"));
  EXPECT_THAT(obj("v 0 0 0\n\nv 1 nan 0\n"), HasSubstr("line 3: 'nan' is not a finite number"));
  EXPECT_THAT(obj("v 0 0\n"), HasSubstr("line 1: a vertex needs three coordinates"));
  EXPECT_THAT(obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), HasSubstr("line 4: face uses vertex 9, but the file has 3"));
  EXPECT_THAT(obj("v 0 0 0\nv 1 0 0\nf 1 2 -7\n"), HasSubstr("line 3: face uses vertex -7"));
  EXPECT_THAT(obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 two 3\n"), HasSubstr("line 4: face corner 'two' names no vertex"));
  EXPECT_THAT(obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0,5 0\nf 1 2 3\n"), HasSubstr("line 4: '0,5' is not a number"));
}

TEST(MeshImport, RefusesVerticesThatAreNotFinite) {
  const TemporaryFolder folder;
  std::string stl = mesh_file("stl", triangulated(quad_grid(2, 2)));
  stl.replace(stl.find("vertex 0 0 1"), 12, "vertex 0 nan 1");
  EXPECT_THAT(refusal(folder.write("nan.stl", stl)), HasSubstr("vertex 1 (counted from 0)"));
  std::string glb = mesh_file("glb", triangulated(quad_grid(2, 2)));
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(glb.data() + glb.find("BIN") + 4 + 12, &infinity, sizeof infinity);
  EXPECT_THAT(refusal(folder.write("infinite.glb", glb)), HasSubstr("vertex 1 (counted from 0)"));
}

TEST(MeshImport, RefusesMeshesWithoutPolygons) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder.write("points.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")), "none");
  EXPECT_NE(refusal(folder.write("points.ply",
                                 "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                                 "property float z\nend_header\n0 0 0\n")),
            "none");
}

TEST(MeshImport, NoticesAPlyHeaderWithoutEnd) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.write("cut.ply", "ply\nformat ascii 1.0\nelement vertex 12\nprop")), HasSubstr("no end"));
}

// 187 bytes that claim fifty million vertices: assimp alone works on them for twenty seconds.
TEST(MeshImport, DoesNotBelieveAHeader) {
  const TemporaryFolder folder;
  std::string ply = mesh_file("ply", quad_grid(2, 2));
  ply.replace(ply.find("vertex 4"), 8, "vertex 50000000");
  std::string off = mesh_file("off", quad_grid(2, 2));
  off.replace(off.find("4 1"), 3, "4 50000000");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(refusal(folder.write("claims.ply", ply)), HasSubstr("its header claims 50000000 vertices"));
  EXPECT_THAT(refusal(folder.write("claims.off", off)), HasSubstr("its header claims 50000000 faces"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST(MeshImport, HoldsMeshesToTheirLimits) {
  const TemporaryFolder folder;
  const Mesh grid = triangulated(quad_grid(20, 20));
  for (const char* extension : {"obj", "off", "ply", "stl", "gltf", "glb"}) {
    SCOPED_TRACE(extension);
    const auto file = folder.write(std::string("grid.") + extension, mesh_file(extension, grid));
    EXPECT_THAT(refusal(file, {.max_vertices = 100}), HasSubstr("vertices"));
    EXPECT_THAT(refusal(file, {.max_faces = 100}), HasSubstr("face"));
  }
}

TEST(MeshImport, SaysWhenMemoryOrTimeRunOut) {
  const TemporaryFolder folder;
  const auto file = folder.write("grid.obj", mesh_file("obj", quad_grid(200, 200)));
  EXPECT_THAT(refusal(file, {.wall_seconds = 0.0}), HasSubstr("longer than 0 s"));
#ifndef BILLOW_SANITIZE
  EXPECT_THAT(refusal(file, {.memory_bytes = 1 << 20}), HasSubstr("more than 1 MiB of memory"));
#endif
}

// ---- what may be opened ----

// A named pipe tells: whoever opens it waits for a writer that never comes.
TEST(MeshImport, NeverOpensAMaterialOutsideItsFolder) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder.path() / "outside.mtl").c_str(), 0600), 0);
  const auto file = folder.write("inner/cloth.obj", "mtllib ../outside.mtl\n" + mesh_file("obj", quad_grid(3, 3)));
  EXPECT_EQ(import_mesh(file, {.wall_seconds = 5.0}).vertices(), 9);
}

// Only what it refers to has to be beside it.
TEST(MeshImport, ReadsAMeshThatIsALinkToAnotherFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "inner");
  for (const std::string extension : {"obj", "off", "ply", "gltf", "glb", "stl"}) {
    folder.write("cloth." + extension, mesh_file(extension, triangulated(quad_grid(3, 3))));
    const auto link = folder.path() / "inner" / ("link." + extension);
    std::filesystem::create_symlink("../cloth." + extension, link);
    EXPECT_EQ(import_mesh(link).vertices(), 9) << extension;
  }
}

TEST(MeshImport, RefusesBuffersOutsideItsFolder) {
  const TemporaryFolder folder;
  const Mesh grid = triangulated(quad_grid(3, 3));
  std::string text = mesh_file("gltf", grid);
  const std::size_t start = text.find("data:"), end = text.find('"', start);
  folder.write("outside.bin", std::string(1000, '\0'));
  folder.write("inner/inside.bin", std::string(1000, '\0'));
  std::filesystem::create_symlink("../outside.bin", folder.path() / "inner/link.bin");
  for (const std::string uri : {"../outside.bin", "link.bin"}) {
    SCOPED_TRACE(uri);
    const auto file = folder.write("inner/cloth.gltf", std::string(text).replace(start, end - start, uri));
    EXPECT_THAT(refusal(file),
                HasSubstr(uri == "link.bin" ? "a link that leads out of its own folder" : "outside its own folder"));
  }
  EXPECT_THAT(refusal(folder.write("inner/cloth.gltf", std::string(text).replace(start, end - start, "inside.bin"))),
              testing::Not(HasSubstr("outside")));
}

}  // namespace
}  // namespace billow::sim
