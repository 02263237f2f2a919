// One small mesh in every layout of every format (tests/corpus/make), and what each must read as.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "base/error.h"
#include "sim/import/assimp_reader.h"
#include "sim/import/mesh_import.h"
#include "sim/mesh/mesh_report.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const fs::path corpus = BILLOW_SOURCE_DIR "/tests/corpus/files";

struct Expected {
  const char* file;
  int vertices, edges, faces;
  double area;  // [m^2]
};

void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.file; }

// clang-format off
const Expected table[] = {
    {"plain.off", 9, 16, 8, 4.0},
    {"one_line.off", 9, 16, 8, 4.0},
    {"two_per_line.off", 9, 16, 8, 4.0},
    {"split_faces.off", 9, 16, 8, 4.0},
    {"comments.off", 9, 16, 8, 4.0},
    {"no_edge_count.off", 9, 16, 8, 4.0},
    {"no_keyword.off", 9, 16, 8, 4.0},
    {"counts_beside_keyword.off", 9, 16, 8, 4.0},
    {"bytes_of_colour.off", 9, 16, 8, 4.0},
    {"three_of_colour.off", 9, 16, 8, 4.0},
    {"unannounced_colour.off", 9, 16, 8, 4.0},
    {"face_rgb.off", 9, 16, 8, 4.0},
    {"face_rgba.off", 9, 16, 8, 4.0},
    {"face_colour_index.off", 9, 16, 8, 4.0},
    {"some_face_colours.off", 9, 16, 8, 4.0},
    {"normals.off", 9, 16, 8, 4.0},
    {"texture.off", 9, 16, 8, 4.0},
    {"everything.off", 9, 16, 8, 4.0},
    {"plane_dimensions.off", 9, 16, 8, 4.0},
    {"mac_lines.off", 9, 16, 8, 4.0},
    {"dos_lines.off", 9, 16, 8, 4.0},
    {"mark.off", 9, 16, 8, 4.0},
    {"binary.off", 9, 16, 8, 4.0},
    {"points_and_edges.off", 9, 16, 8, 4.0},
    {"quads_wrapped.off", 9, 12, 4, 4.0},
    {"plain.ply", 9, 16, 8, 4.0},
    {"camera_first.ply", 9, 16, 8, 4.0},
    {"faces_first.ply", 9, 16, 8, 4.0},
    {"strips.ply", 9, 16, 8, 4.0},
    {"one_line.ply", 9, 16, 8, 4.0},
    {"vertex_index.ply", 9, 16, 8, 4.0},
    {"more_of_faces.ply", 9, 16, 8, 4.0},
    {"more_of_vertices.ply", 9, 16, 8, 4.0},
    {"mac_lines.ply", 9, 16, 8, 4.0},
    {"mark.ply", 9, 16, 8, 4.0},
    {"utf16.ply", 9, 16, 8, 4.0},
    {"binary_little_endian.ply", 9, 16, 8, 4.0},
    {"binary_big_endian.ply", 9, 16, 8, 4.0},
    {"binary_dos_header.ply", 9, 16, 8, 4.0},
    {"binary_camera_first.ply", 9, 16, 8, 4.0},
    {"plain.obj", 9, 16, 8, 4.0},
    {"mark.obj", 9, 16, 8, 4.0},
    {"utf16_little.obj", 9, 16, 8, 4.0},
    {"utf16_big.obj", 9, 16, 8, 4.0},
    {"mac_lines.obj", 9, 16, 8, 4.0},
    {"dos_lines.obj", 9, 16, 8, 4.0},
    {"faces_first.obj", 9, 16, 8, 4.0},
    {"from_the_end.obj", 9, 16, 8, 4.0},
    {"continued.obj", 9, 16, 8, 4.0},
    {"colours.obj", 9, 16, 8, 4.0},
    {"no_leading_digit.obj", 3, 3, 1, 0.5},
    {"utm.obj", 9, 16, 8, 0.0004},
    {"concave.obj", 5, 7, 3, 2.5},
    {"text.stl", 9, 16, 8, 4.0},
    {"two_solids.stl", 9, 16, 8, 4.0},
    {"capitals.stl", 9, 16, 8, 4.0},
    {"binary.stl", 9, 16, 8, 4.0},
    {"binary_called_solid.stl", 9, 16, 8, 4.0},
    {"plain.gltf", 9, 16, 8, 4.0},
    {"without_indices.gltf", 9, 16, 8, 4.0},
    {"strip.gltf", 9, 16, 8, 4.0},
    {"bytes_for_indices.gltf", 9, 16, 8, 4.0},
    {"ints_for_indices.gltf", 9, 16, 8, 4.0},
    {"interleaved.gltf", 9, 16, 8, 4.0},
    {"quantised_short.gltf", 9, 16, 8, 4.0},
    {"quantised_byte.gltf", 9, 16, 8, 4.0},
    {"unnamed_scene.gltf", 9, 16, 8, 4.0},
    {"fan.gltf", 9, 16, 8, 4.0},
    {"plain.glb", 9, 16, 8, 4.0},
    {"matrix.gltf", 9, 16, 8, 16.0},
    {"sparse.gltf", 9, 16, 8, 11.683454263877431},
    {"morphed.gltf", 9, 16, 8, 8.47213595499958},
};
// clang-format on

class Corpus : public testing::TestWithParam<Expected> {};
INSTANTIATE_TEST_SUITE_P(Import, Corpus, testing::ValuesIn(table), [](const auto& info) {
  std::string name = info.param.file;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

TEST_P(Corpus, ReadsAsItShould) {
  const Mesh mesh = import_mesh(corpus / GetParam().file);
  const MeshReport report = report_of(mesh);
  EXPECT_EQ(report.vertices, GetParam().vertices);
  EXPECT_EQ(report.edges, GetParam().edges);
  EXPECT_EQ(report.triangles + report.quads, GetParam().faces);
  EXPECT_NEAR(report.area, GetParam().area, 1e-6 * GetParam().area);
  EXPECT_EQ(report.turned_edges.count, 0);
  EXPECT_EQ(report.dropped_faces, 0);
  EXPECT_EQ(report.volume, 0.0);
}

// What the table leaves out is tested below.
TEST(CorpusFiles, AreAllInTheTable) {
  std::set<std::string> known = {"needs_draco.gltf"};
  for (const Expected& expected : table) known.insert(expected.file);
  for (const fs::directory_entry& file : fs::directory_iterator(corpus))
    EXPECT_TRUE(known.contains(file.path().filename().string())) << file.path();
}

// Where assimp reads a layout, it reads the same.
TEST(CorpusFiles, AgreeWithAssimpWhereItReadsThem) {
  const ImportLimits limits;
  for (const char* file : {"plain.off", "plain.ply", "more_of_faces.ply", "binary_little_endian.ply",
                           "binary_big_endian.ply", "plain.obj", "dos_lines.obj", "from_the_end.obj", "text.stl",
                           "two_solids.stl", "binary.stl", "plain.gltf", "plain.glb", "matrix.gltf"}) {
    SCOPED_TRACE(file);
    const Mesh ours = import_mesh(corpus / file), theirs = weld(read_with_assimp(corpus / file, limits));
    ASSERT_EQ(ours.vertices(), theirs.vertices());
    ASSERT_EQ(ours.face.size(), theirs.face.size());
    for (std::size_t f = 0; f < ours.face.size(); ++f)
      for (int c = 0; c < corner_count(ours.face[f]); ++c)
        EXPECT_TRUE(ours.position.row(ours.face[f][c]).isApprox(theirs.position.row(theirs.face[f][c]), 1e-6) ||
                    ours.position.row(ours.face[f][c]).norm() < 1e-6);
  }
}

std::string refusal(const fs::path& file) {
  try {
    import_mesh(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(CorpusFiles, NameTheExtensionThatIsMissing) {
  EXPECT_THAT(refusal(corpus / "needs_draco.gltf"), HasSubstr("needs the extension KHR_draco_mesh_compression"));
}

TEST(CorpusFiles, KeepColoursAndWeights) {
  const Mesh ply = import_mesh(corpus / "more_of_vertices.ply");
  EXPECT_NEAR(ply.weight.at("confidence")(8), 1.0f, 1e-6f);
  EXPECT_NEAR(ply.colour(8, 2), 80.0f / 255.0f, 1e-6f);
  EXPECT_THAT(ply.ignored, ElementsAre("elements 'edge'"));
  EXPECT_NEAR(import_mesh(corpus / "colours.obj").colour(4, 1), 128.0f / 255.0f, 1e-6f);
  EXPECT_NEAR(import_mesh(corpus / "bytes_of_colour.off").colour(3, 1), 30.0f / 255.0f, 1e-6f);
  EXPECT_NEAR(import_mesh(corpus / "three_of_colour.off").colour(3, 2), 0.25f, 1e-6f);
}

TEST(CorpusFiles, KeepTextureCoordinates) {
  for (const char* file : {"texture.off", "more_of_faces.ply"}) {
    const Mesh mesh = import_mesh(corpus / file);
    ASSERT_EQ(mesh.uv.size(), 8u) << file;
    for (std::size_t f = 0; f < 8; ++f)
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(mesh.uv[f][c], Eigen::Vector2f(0.5 * mesh.position.row(mesh.face[f][c]).head<2>().cast<float>()));
  }
}

TEST(CorpusFiles, KeepTheShapeOfFarCoordinates) {
  const Mesh mesh = import_mesh(corpus / "utm.obj");
  const Eigen::RowVector3d side = mesh.position.row(1) - mesh.position.row(0);
  EXPECT_NEAR(side.norm(), 0.01, 1e-9);
}

TEST(CorpusFiles, CutConcavePolygonsInside) {
  const Mesh mesh = import_mesh(corpus / "concave.obj");
  EXPECT_EQ(report_of(mesh).turned_edges.count, 0);
  for (const Face& face : mesh.face) {
    const Eigen::Vector3d a = mesh.position.row(face[0]), b = mesh.position.row(face[1]),
                          c = mesh.position.row(face[2]);
    EXPECT_GT((b - a).cross(c - a).z(), 0.0);
  }
}

TEST(CorpusFiles, NameGroupsWithBlanks) {
  const test::TemporaryFolder folder;
  const Mesh mesh = import_mesh(
      folder.write("blanks.obj", "o my cloth\nusemtl dark  red\ng left hem\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  for (const char* name : {"my cloth", "dark  red", "left hem", "left", "hem"})
    EXPECT_TRUE(mesh.group.contains(name)) << name;
  EXPECT_TRUE(import_mesh(corpus / "two_solids.stl").group.contains("left half"));
}

// ---- what a file declares ----

TEST(Declared, CountsThatDoNotFitAreRefused) {
  const test::TemporaryFolder folder;
  const auto off = [&](const char* text) { return refusal(folder.write("counts.off", text)); };
  EXPECT_THAT(off("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), HasSubstr("it ends in line 6, where"));
  EXPECT_THAT(off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n"),
              HasSubstr("line 7: it declares 3 vertices and 1 faces, but more follows"));
  EXPECT_THAT(off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
              HasSubstr("line 6: a face uses vertex 7 (counted from 0), but there are 3"));
  EXPECT_THAT(off("OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n"), HasSubstr("line 4: a number of vertex 2 of 3"));
  EXPECT_THAT(off("LIST\n"), HasSubstr("neither OFF nor a count of vertices"));
  EXPECT_THAT(off("4nOFF\n7\n1 1 1\n"), HasSubstr("7 dimensions"));
}

TEST(Declared, NothingValidIsCalledBroken) {
  for (const Expected& expected : table) EXPECT_EQ(refusal(corpus / expected.file), "none");
}

TEST(Declared, PlyFaultsNameTheirLine) {
  const test::TemporaryFolder folder;
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_THAT(refusal(folder.write("a.ply", head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n")),
              HasSubstr("line 13: a face uses vertex 9"));
  EXPECT_THAT(refusal(folder.write("b.ply", head + "0 0 0\n1 0 zero\n")), HasSubstr("line 11"));
  EXPECT_THAT(refusal(folder.write("c.ply", head + "0 0 0\n1 0 0\n")), HasSubstr("it ends in line 11"));
}

TEST(Declared, TextStlThatIsCutShortIsRefused) {
  const test::TemporaryFolder folder;
  std::string text = test::mesh_file("stl", test::triangulated(test::quad_grid(2, 2)));
  EXPECT_EQ(refusal(folder.write("whole.stl", text)), "none");
  text.resize(text.find("endfacet") + 9);
  EXPECT_THAT(refusal(folder.write("cut.stl", text)), HasSubstr("ends without 'endsolid' after 1 facets"));
}

TEST(Declared, ObjLinesOfNoKnownKindAreTold) {
  const test::TemporaryFolder folder;
  const Mesh mesh = import_mesh(folder.write("odd.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nff 3 2 1\nvn 0 0 1\n"));
  EXPECT_THAT(mesh.ignored, ElementsAre("lines that begin with 'ff'"));
}

TEST(Declared, BinaryStlThatIsCutShortIsRefused) {
  const test::TemporaryFolder folder;
  std::string bytes(80, ' ');
  bytes += std::string("\x05\0\0\0", 4) + std::string(50, '\0');
  EXPECT_THAT(refusal(folder.write("cut.stl", bytes)), HasSubstr("claims 5 faces, but the file has room for 1"));
}

}  // namespace
}  // namespace billow::sim
