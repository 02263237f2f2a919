// What a body looks like: by the scene, or by its mesh's file; and where its mesh is put.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "cli/scene/mesh_warnings.h"
#include "cli/scene/scene.h"
#include "render/image/png.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

using cli::read_scene;
using cli::Scene;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SceneLook : public testing::Test {
 protected:
  SceneLook() {
    folder_.write(
        "two.obj",
        "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "usemtl lace\nf 1/1 2/2 3/3 4/4\nusemtl glass\nf 2/1 5/2 6/3 3/4\n");
    folder_.write("two.mtl",
                  "newmtl lace\nKd 0.5 0 0\nmap_Kd lace.png\nnewmtl glass\nKd 1 0.5 0\nd 0.25\nmap_Bump bumps.png\n");
    render::write_png(folder_.path() / "lace.png", lace());
  }

  // Its right half is a hole.
  static render::Image lace() {
    render::Image image(4, 4, 4);
    for (std::size_t p = 0; p < 16; ++p) image.pixels[4 * p + 3] = p % 4 < 2 ? 255 : 0;
    return image;
  }

  Scene read(const std::string& body) { return read_scene(folder_.scene("billow: 1\nbodies: [{" + body + "}]\n")); }
  std::vector<std::string> warnings(const std::string& body) { return cli::mesh_warnings(read(body)); }

  test::SceneFolder folder_;
};

TEST_F(SceneLook, TakesTheMaterialsOfTheMesh) {
  const Scene scene = read("cloth: {mesh: two.obj}");
  const cli::BodySpec& body = scene.bodies[0];
  ASSERT_EQ(body.finish.size(), 2u);
  EXPECT_EQ(body.finish[0].texture.width, 4);
  EXPECT_EQ(body.finish[0].colour, Eigen::Vector3f::Ones());
  EXPECT_EQ(body.finish[0].alpha, AlphaMode::cut_out);
  EXPECT_EQ(body.finish[1].alpha, AlphaMode::blend);
  EXPECT_FLOAT_EQ(body.finish[1].opacity, 0.25f);
  EXPECT_NEAR(body.finish[1].colour.y(), 0.2140f, 1e-4f);  // 0.5 of sRGB
  EXPECT_THAT(body.mesh.face_material, ElementsAre(0, 1));
  EXPECT_THAT(body.warnings, ElementsAre("not used of two.obj: maps map_Bump of materials"));
}

TEST_F(SceneLook, TheScenesWordIsTheLast) {
  for (const char* look : {"texture: lace.png", "texture: none", "colour: \"#ff0000\""}) {
    const Scene scene = read(std::string("cloth: {mesh: two.obj}, ") + look);
    EXPECT_EQ(scene.bodies[0].finish.size(), 1u) << look;
    EXPECT_THAT(scene.bodies[0].mesh.face_material, IsEmpty()) << look;
  }
  EXPECT_EQ(read("cloth: {mesh: two.obj}, colour: \"#ff0000\"").bodies[0].finish[0].colour, Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(read("cloth: {mesh: two.obj}, colour: \"#ff0000\", texture: mesh").bodies[0].finish.size(), 2u);
  EXPECT_EQ(read("cloth: {mesh: two.obj}, alpha: opaque").bodies[0].finish[1].alpha, AlphaMode::opaque);
  EXPECT_EQ(read("cloth: {mesh: two.obj}, texture: lace.png").bodies[0].finish[0].alpha, AlphaMode::cut_out);
}

TEST_F(SceneLook, AMissingTextureIsToldAndLeftOut) {
  std::filesystem::remove(folder_.path() / "lace.png");
  const Scene scene = read("cloth: {mesh: two.obj}");
  EXPECT_TRUE(scene.bodies[0].finish[0].texture.pixels.empty());
  EXPECT_THAT(cli::mesh_warnings(scene), testing::Contains(HasSubstr("texture 'lace.png' of material 'lace'")));
}

TEST_F(SceneLook, ATextureOutsideTheMeshesFolderIsNotOpened) {
  folder_.write("inner/two.obj", "mtllib two.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder_.write("inner/two.mtl", "newmtl a\nmap_Kd ../lace.png\n");
  EXPECT_THAT(warnings("cloth: {mesh: inner/two.obj}"), testing::Contains(HasSubstr("outside its own folder")));
}

// Headers that claim 2^26 pixels each, without any behind them: a damaged texture costs as much time as a good one.
TEST_F(SceneLook, TexturesHaveSoManyPixelsInAll) {
  const std::string claim("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x20\0\0\0\x20\0\x08\x02\0\0\0", 29);
  folder_.write("claim.png", claim);
  std::string library, mesh = "mtllib many.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    library += std::string("newmtl ") + name + "\nmap_Kd claim.png\n";
    mesh += std::string("usemtl ") + name + "\nf 1 2 3\n";
  }
  folder_.write("many.mtl", library);
  folder_.write("many.obj", mesh);
  const std::vector<std::string> told = warnings("cloth: {mesh: many.obj}");
  for (const char* name : {"a", "d"})
    EXPECT_THAT(told, testing::Contains(HasSubstr(fmt::format("of material '{}': it: the PNG image is cut", name))));
  EXPECT_THAT(told, testing::Contains(HasSubstr("of material 'e': with it, the scene's textures have more than 2^28")));
}

TEST_F(SceneLook, TheHashCountsTexturesOfMaterials) {
  const std::string before = read("cloth: {mesh: two.obj}").hash;
  render::Image other = lace();
  other.pixels[0] = 99;
  render::write_png(folder_.path() / "lace.png", other);
  const std::string after = read("cloth: {mesh: two.obj}").hash;
  EXPECT_NE(after, before);
  folder_.write("two.mtl", "newmtl lace\nmap_Kd lace.png\nnewmtl glass\nKd 0 0.5 0\nd 0.25\n");
  EXPECT_NE(read("cloth: {mesh: two.obj}").hash, after);
}

TEST_F(SceneLook, ReadsJpeg) {
  // 8 x 8 of grey, as ffmpeg makes it.
  const unsigned char bytes[] = {
      255, 216, 255, 219, 0,   67,  0,   8,   62,  62,  73,  62,  73,  85,  85,  85,  85,  85,  85,  100, 93,
      100, 104, 104, 104, 100, 100, 100, 100, 104, 104, 104, 112, 112, 112, 131, 131, 131, 112, 112, 112, 104,
      104, 112, 112, 124, 124, 131, 131, 143, 147, 143, 135, 135, 131, 135, 147, 147, 155, 155, 155, 186, 186,
      178, 178, 217, 217, 224, 255, 255, 255, 255, 196, 0,   74,  0,   1,   0,   0,   0,   0,   0,   0,   0,
      0,   0,   0,   0,   0,   0,   0,   0,   0,   1,   1,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,
      0,   0,   0,   0,   0,   0,   16,  1,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,
      0,   0,   0,   17,  1,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,
      255, 192, 0,   17,  8,   0,   8,   0,   8,   3,   1,   34,  0,   2,   17,  0,   3,   17,  0,   255, 218,
      0,   12,  3,   1,   0,   2,   17,  3,   17,  0,   63,  0,   0,   15,  255, 217};
  folder_.write("grey.jpg", {reinterpret_cast<const char*>(bytes), sizeof bytes});
  const Scene scene = read("cloth: {mesh: two.obj}, texture: grey.jpg");
  EXPECT_EQ(scene.bodies[0].finish[0].texture.width, 8);
  EXPECT_EQ(scene.bodies[0].finish[0].texture.channels, 3);
  EXPECT_NEAR(scene.bodies[0].finish[0].texture.pixels[0], 128, 8);
  folder_.write("cut.jpg", {reinterpret_cast<const char*>(bytes), sizeof bytes - 20});
  EXPECT_THAT(test::scene_error(folder_.scene("billow: 1\nbodies: [{cloth: {mesh: two.obj}, texture: cut.jpg}]\n")),
              HasSubstr("the JPEG image is damaged"));
  folder_.write("a.gif", "GIF89a");
  EXPECT_THAT(test::scene_error(folder_.scene("billow: 1\nbodies: [{cloth: {mesh: two.obj}, texture: a.gif}]\n")),
              HasSubstr("is neither a PNG nor a JPEG image; convert it to one of these"));
}

TEST_F(SceneLook, ShowsColoursOfVertices) {
  folder_.write("painted.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
  EXPECT_TRUE(read("cloth: {mesh: painted.obj}").bodies[0].shows_vertex_colours);
  EXPECT_FALSE(read("cloth: {mesh: painted.obj}, texture: none").bodies[0].shows_vertex_colours);
}

// ---- where it is put ----

TEST_F(SceneLook, UnitsAndAxesSetAMeshRight) {
  folder_.write("z.obj", "v 0 0 0\nv 100 0 0\nv 0 0 200\nf 1 2 3\n");
  const Scene scene = read("cloth: {mesh: z.obj, transform: {unit: cm, z_up: true, scale: [1, 3, 1]}}");
  const Eigen::MatrixX3d& position = scene.bodies[0].mesh.position;
  EXPECT_TRUE(position.row(1).isApprox(Eigen::RowVector3d(1, 0, 0)));
  EXPECT_TRUE(position.row(2).isApprox(Eigen::RowVector3d(0, 6, 0)));
}

TEST_F(SceneLook, WarnsOfAnotherUnit) {
  folder_.write("flag.obj", "v 0 0 0\nv 150 0 0\nv 150 100 0\nf 1 2 3\n");
  EXPECT_THAT(warnings("cloth: {mesh: flag.obj}"),
              ElementsAre(HasSubstr("if the file is in cm, say 'transform: {unit: cm}'")));
  EXPECT_THAT(warnings("cloth: {mesh: flag.obj, transform: {unit: cm}}"), IsEmpty());
  EXPECT_THAT(warnings("cloth: {mesh: flag.obj, transform: {unit: m}}"), IsEmpty());
}

TEST_F(SceneLook, WarnsOfPiecesThatNoPinHolds) {
  folder_.write("parts.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\nf 4 5 6\n");
  EXPECT_THAT(warnings("cloth: {mesh: parts.obj, pins: [{vertices: [0]}]}"),
              ElementsAre(HasSubstr("that no pin holds and that will fall: 1 of 2, the largest 3 vertices")));
  EXPECT_THAT(read("cloth: {mesh: parts.obj, pins: [{vertices: [0]}]}").bodies[0].framed_points, ElementsAre(0, 1, 2));
  EXPECT_THAT(warnings("cloth: {mesh: parts.obj, pins: [{vertices: [0, 3]}]}"), IsEmpty());
  EXPECT_THAT(warnings("cloth: {mesh: parts.obj}"), IsEmpty());
  EXPECT_THAT(read("cloth: {mesh: parts.obj, pins: [{vertices: [0]}]}, contact: {}").bodies[0].framed_points,
              IsEmpty());
}

TEST_F(SceneLook, ClosesHolesOfSoftBodies) {
  folder_.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const auto error = [&](const std::string& more) {
    return test::scene_error(folder_.scene("billow: 1\nbodies: [{soft: {mesh: open.obj" + more + "}}]\n"));
  };
  EXPECT_EQ(read("soft: {mesh: open.obj, close_holes: true}").bodies[0].mesh.face.size(), 4u);
  const Scene open = read("soft: {mesh: open.obj}");
  try {
    build_structure(open);
    ADD_FAILURE() << "an open mesh makes no soft body";
  } catch (const InputError& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("such edges: 3, holes: 1; close the mesh, say 'close_holes: true'"));
  }
  EXPECT_EQ(error(", close_holes: true"), "");
}

TEST_F(SceneLook, WarnsOfCachesThatAreTooCoarse) {
  const auto read_at = [&](const std::string& place) {
    return cli::mesh_warnings(read_scene(folder_.scene(
        "billow: 1\ncaches: [pc2]\nbodies: [{cloth: {mesh: cloth.obj, transform: {translate: " + place + "}}}]\n")));
  };
  EXPECT_THAT(read_at("[0, 0, 0]"), IsEmpty());
  EXPECT_THAT(read_at("[500000, 0, 0]"),
              ElementsAre(HasSubstr("body body_0: caches hold single precision, steps of 0.06 m")));
}

TEST_F(SceneLook, PinsByWeight) {
  folder_.write(
      "weighed.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property float hold\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 0.9 255 0 0\n1 0 0 0.5 0 0 0\n1 1 0 0.6 0 0 0\n"
      "0 1 0 0 200 0 0\n4 0 1 2 3\n");
  const auto pinned = [&](const std::string& pin) {
    return read("cloth: {mesh: weighed.ply, pins: [{" + pin + "}]}").bodies[0].pins[0].vertices;
  };
  EXPECT_THAT(pinned("weights: hold"), ElementsAre(0, 2));
  EXPECT_THAT(pinned("weights: hold, over: 0.7"), ElementsAre(0));
  EXPECT_THAT(pinned("weights: red"), ElementsAre(0, 3));
  const auto error = [&](const std::string& pin) {
    return test::scene_error(
        folder_.scene("billow: 1\nbodies: [{cloth: {mesh: weighed.ply, pins: [{" + pin + "}]}}]\n"));
  };
  EXPECT_THAT(error("weights: nobody"),
              HasSubstr("there are no weights 'nobody'; the mesh has 'hold', 'red', 'green', 'blue'"));
  EXPECT_THAT(error("weights: hold, over: 2"),
              HasSubstr("no vertex has a weight 'hold' over 2: they go from 0 to 0.9"));
  EXPECT_THAT(error("vertices: [0], over: 1"), HasSubstr("'over' bounds weights, and this pin has none"));
}

}  // namespace
}  // namespace billow
