// Textures with an alpha: holes, and what shows through.
#include <gtest/gtest.h>

#include <array>

#include "render/frame/mesh_renderer.h"
#include "render/image/compare.h"
#include "render/image/png.h"
#include "tests/support/drawn_sheet.h"
#include "tests/support/golden.h"

namespace billow::render {
namespace {

using test::DrawnSheet;
using test::flat_sheet;
using test::frontal_settings;

// Red all over; the left half as good as not there.
Image half_there() {
  Image image(16, 16, 4);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const std::array<std::uint8_t, 4> pixel{200, 30, 30, static_cast<std::uint8_t>(x < 8 ? 0 : 255)};
      std::copy(pixel.begin(), pixel.end(), image.row(y) + 4 * x);
    }
  return image;
}

DrawnSheet sheet_with(AlphaMode alpha, float opacity = 1.0f) {
  DrawnSheet sheet = flat_sheet(Eigen::Vector3f(1, 0, 0));
  sheet.body.finish[0] = {half_there(), Eigen::Vector3f::Ones(), opacity, alpha};
  return sheet;
}

std::array<int, 4> pixel(const Image& image, int x, int y) {
  std::array<int, 4> value{0, 0, 0, 255};
  for (int c = 0; c < image.channels; ++c) value[c] = image.row(y)[image.channels * x + c];
  return value;
}

// The sheet is 2 m wide in a picture of 4 m: 32 of 64 pixels; holes are left of the middle.
constexpr int hole_x = 24, cloth_x = 40, middle_y = 32;

Image bare() {
  DrawnSheet sheet = flat_sheet();
  MeshRenderer renderer(frontal_settings(), {}, sheet.bounds);
  return std::get<Image>(renderer.draw(View::textured, {}));
}

// The ball that would be behind it is not there, but its own other side and its shadow are.
TEST(Finish, LaceIsDrawnWithItsHoles) {
  DrawnSheet sheet = test::wavy_sheet();
  sheet.body.finish[0] = {read_png(BILLOW_SOURCE_DIR "/assets/textures/lace.png"), Eigen::Vector3f::Ones(), 1.0f,
                          AlphaMode::cut_out};
  EXPECT_GOLDEN(draw_sheet(sheet, View::textured, test::sheet_settings()), "sheet_lace");
  EXPECT_GOLDEN(draw_sheet(sheet, View::velocity, test::sheet_settings()), "sheet_lace_velocity");
  sheet.body.finish[0].alpha = AlphaMode::blend;
  sheet.body.finish[0].opacity = 0.7f;
  EXPECT_GOLDEN(draw_sheet(sheet, View::textured, test::sheet_settings()), "sheet_lace_blended");
}

TEST(Finish, OpaqueIgnoresTheAlpha) {
  const Image seen = draw_sheet(sheet_with(AlphaMode::opaque), View::textured, frontal_settings());
  for (int c = 0; c < 3; ++c)  // but for the light
    EXPECT_NEAR(pixel(seen, hole_x, middle_y)[c], pixel(seen, cloth_x, middle_y)[c], 12) << c;
}

TEST(Finish, CutOutLeavesNothingInTheHoles) {
  const Image seen = draw_sheet(sheet_with(AlphaMode::cut_out), View::textured, frontal_settings());
  const Image opaque = draw_sheet(sheet_with(AlphaMode::opaque), View::textured, frontal_settings());
  EXPECT_EQ(pixel(seen, hole_x, middle_y), pixel(bare(), hole_x, middle_y));
  EXPECT_EQ(pixel(seen, cloth_x, middle_y), pixel(opaque, cloth_x, middle_y));
}

TEST(Finish, HolesAreHolesInEveryView) {
  const DrawnSheet sheet = sheet_with(AlphaMode::cut_out);
  const Image velocity = draw_sheet(sheet, View::velocity, frontal_settings());
  EXPECT_EQ(pixel(velocity, hole_x, middle_y), pixel(velocity, 1, 1));
  EXPECT_NE(pixel(velocity, cloth_x, middle_y), pixel(velocity, 1, 1));
  MeshRenderer renderer(frontal_settings(), {sheet.body}, sheet.bounds);
  const auto data = std::get<DataImage>(renderer.draw(View::data, {sheet.state}));
  EXPECT_EQ(data.channels[3].name, "A");
  EXPECT_EQ(data.channels[3].value[middle_y * 64 + hole_x], 0.0f);
  EXPECT_EQ(data.channels[3].value[middle_y * 64 + cloth_x], 1.0f);
}

TEST(Finish, HolesHaveNoAlphaAndNoHalo) {
  Settings settings = frontal_settings();
  settings.background.none = true;
  const Image seen = draw_sheet(sheet_with(AlphaMode::cut_out), View::textured, settings);
  EXPECT_EQ(pixel(seen, hole_x, middle_y)[3], 0);
  EXPECT_EQ(pixel(seen, cloth_x, middle_y)[3], 255);
}

TEST(Finish, BlendShowsWhatIsBehind) {
  Settings settings = frontal_settings();
  settings.background.none = true;
  const Image seen = draw_sheet(sheet_with(AlphaMode::blend, 0.5f), View::textured, settings);
  const Image opaque = draw_sheet(sheet_with(AlphaMode::opaque), View::textured, settings);
  EXPECT_EQ(pixel(seen, hole_x, middle_y)[3], 0);
  EXPECT_NEAR(pixel(seen, cloth_x, middle_y)[3], 128, 1);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(pixel(seen, cloth_x, middle_y)[c], pixel(opaque, cloth_x, middle_y)[c], 2) << c;
}

// Farther triangles first, whichever body comes first.
TEST(Finish, BlendedBodiesAreSortedByDepth) {
  DrawnSheet red = sheet_with(AlphaMode::blend, 0.5f), blue = red;
  blue.body.finish[0].colour = {0.1f, 0.3f, 1.0f};
  blue.body.finish[0].texture = {};
  blue.state.position.col(2).array() -= 0.5f;
  const auto drawn = [&](const DrawnSheet& one, const DrawnSheet& two) {
    MeshRenderer renderer(frontal_settings(), {one.body, two.body}, red.bounds);
    return std::get<Image>(renderer.draw(View::textured, {one.state, two.state}));
  };
  EXPECT_EQ(drawn(red, blue).pixels, drawn(blue, red).pixels);
  EXPECT_GT(pixel(drawn(red, blue), hole_x, middle_y)[2], pixel(drawn(red, blue), hole_x, middle_y)[0]);
}

TEST(Finish, MaterialsHaveTheirOwnTriangles) {
  DrawnSheet sheet = flat_sheet();
  const int triangles = static_cast<int>(sheet.body.surface.triangle.rows());
  sheet.body.surface.material = Eigen::VectorXi::Zero(triangles);
  sheet.body.surface.material.tail(triangles / 2).setOnes();
  sheet.body.finish = {Finish(), Finish()};
  sheet.body.finish[0].colour = {0.8f, 0.1f, 0.1f};
  sheet.body.finish[1].colour = {0.1f, 0.1f, 0.8f};
  const Image seen = draw_sheet(sheet, View::textured, frontal_settings());
  EXPECT_GT(pixel(seen, middle_y, 24)[0], pixel(seen, middle_y, 24)[2]);
  EXPECT_LT(pixel(seen, middle_y, 40)[0], pixel(seen, middle_y, 40)[2]);
}

TEST(Finish, VertexColoursTintWhatIsDrawn) {
  DrawnSheet sheet = flat_sheet();
  sheet.body.finish[0].colour.setOnes();
  sheet.body.surface.colour = Eigen::RowVector3f(0.1f, 0.8f, 0.1f).replicate(sheet.body.surface.uv.rows(), 1);
  const auto seen = pixel(draw_sheet(sheet, View::textured, frontal_settings()), middle_y, middle_y);
  EXPECT_GT(seen[1], 2 * seen[0]);
}

}  // namespace
}  // namespace billow::render
