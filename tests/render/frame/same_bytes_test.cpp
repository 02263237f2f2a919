// What a picture's bytes do not depend on: which software draws it, and in how many tiles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "render/frame/mesh_renderer.h"
#include "render/image/png.h"
#include "tests/support/drawn_sheet.h"

namespace billow::render {
namespace {

/// Something to draw, with everything in it that pictures can have.
struct Look {
  std::string name;
  std::vector<View> views;
  std::function<void(test::DrawnSheet& sheet, Settings& settings)> change;
};

const std::vector<View> all_views{View::textured, View::velocity, View::data, View::depth, View::normal, View::id};

Finish lace(AlphaMode alpha, float opacity) {
  return {read_png(BILLOW_SOURCE_DIR "/assets/textures/lace.png"), Eigen::Vector3f::Ones(), opacity, alpha};
}

std::vector<Look> looks() {
  const auto samples = [](int count) {
    return [count](test::DrawnSheet&, Settings& settings) { settings.samples = count; };
  };
  return {
      {"1 sample", all_views, samples(1)},
      {"4 samples, legend", all_views, [](auto&, Settings& settings) { settings.legend = true; }},
      {"16 samples", all_views, samples(16)},
      {"no background", {View::textured, View::velocity}, [](auto&, Settings& s) { s.background.none = true; }},
      {"a shadow alone", {View::textured}, [](auto&, Settings& s) { s.background.none = s.shadow_only = true; }},
      {"speed", {View::velocity}, [](auto&, Settings& s) { s.velocity_colour = VelocityColour::magnitude; }},
      {"exact velocity", {View::velocity}, [](auto&, Settings& s) { s.velocity_shading = 0.0; }},
      {"turning camera", {View::textured, View::data}, [](auto&, Settings& s) { s.camera.turn_period = 4.0; }},
      {"holes", all_views, [](auto& sheet, auto&) { sheet.body.finish[0] = lace(AlphaMode::cut_out, 1.0f); }},
      {"glass", all_views, [](auto& sheet, auto&) { sheet.body.finish[0] = lace(AlphaMode::blend, 0.7f); }},
  };
}

// A frame of every view; the first again after the others.
std::vector<Picture> draw_look(const Look& look, const DrawingOptions& options) {
  test::DrawnSheet sheet = test::wavy_sheet();
  Settings settings = test::sheet_settings();
  settings.width = 160, settings.height = 120;
  look.change(sheet, settings);
  MeshRenderer renderer(settings, {sheet.body}, sheet.bounds, options);
  std::vector<Picture> pictures;
  for (const View view : look.views) pictures.push_back(renderer.draw(view, {sheet.state}, {0.1, 0.0, 0.0}, 0.7));
  pictures.push_back(renderer.draw(look.views.front(), {sheet.state}, {0.1, 0.0, 0.0}, 0.8));
  return pictures;
}

// Numbers of pictures, pixel by pixel, in steps of 1/255 of what is usual for them.
std::vector<float> numbers_of(const Picture& picture) {
  if (const auto* image = std::get_if<Image>(&picture)) return {image->pixels.begin(), image->pixels.end()};
  std::vector<float> numbers;
  if (const auto* depth = std::get_if<Image16>(&picture))
    for (const std::uint16_t code : depth->pixels) numbers.push_back(code / 257.0f);
  if (const auto* data = std::get_if<DataImage>(&picture))
    for (const DataImage::Channel& channel : data->channels)
      for (const float value : channel.value) numbers.push_back(255.0f * value);
  return numbers;
}

// The share of them that differ by more than `step`.
double share_that_differs(const Picture& a, const Picture& b, float step) {
  const std::vector<float> x = numbers_of(a), y = numbers_of(b);
  EXPECT_EQ(x.size(), y.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < x.size(); ++k) count += x[k] != y[k] && !(std::abs(x[k] - y[k]) <= step);
  return static_cast<double>(count) / static_cast<double>(x.size());
}

void expect_same(const Look& look, const DrawingOptions& one, const DrawingOptions& other) {
  const std::vector<Picture> a = draw_look(look, one), b = draw_look(look, other);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(share_that_differs(a[k], b[k], 0.0f), 0.0) << look.name;
}

DrawingOptions by(BackendKind kind, const TileLimits& tiles = {}) { return {.backend = {kind, {}}, .tiles = tiles}; }

constexpr TileLimits small_tiles{.side = 64, .data_viewport = 128};

TEST(SameBytes, FromOsmesaAndEgl) {
  for (const Look& look : looks()) expect_same(look, by(BackendKind::osmesa), by(BackendKind::egl));
}

TEST(SameBytes, FromOsmesaAndEglInTiles) {
  expect_same(looks()[2], by(BackendKind::osmesa, small_tiles), by(BackendKind::egl, small_tiles));
}

// One renderer of each is there; they take turns on one thread.
TEST(SameBytes, FromBothAtOnce) {
  const test::DrawnSheet sheet = test::wavy_sheet();
  MeshRenderer osmesa(test::sheet_settings(), {sheet.body}, sheet.bounds, by(BackendKind::osmesa));
  const Picture alone = osmesa.draw(View::textured, {sheet.state});
  MeshRenderer egl(test::sheet_settings(), {sheet.body}, sheet.bounds, by(BackendKind::egl));
  for (int turn = 0; turn < 3; ++turn)
    for (MeshRenderer* renderer : {&egl, &osmesa})
      EXPECT_EQ(std::get<Image>(renderer->draw(View::textured, {sheet.state})).pixels, std::get<Image>(alone).pixels);
}

// GL interpolates from where its framebuffer begins, and rounds: last bits of a colour, and which of two triangles has
// a sample at their common edge, depend on the tile. Nothing else does.
TEST(Tiles, ShowTheSamePicture) {
  for (const Look& look : looks()) {
    const std::vector<Picture> whole = draw_look(look, {}), tiled = draw_look(look, {.tiles = small_tiles});
    for (std::size_t k = 0; k < whole.size(); ++k) {
      EXPECT_LT(share_that_differs(whole[k], tiled[k], 0.01f), 1e-3) << look.name << ", picture " << k;
      EXPECT_LT(share_that_differs(whole[k], tiled[k], 1.0f), 2e-4) << look.name << ", picture " << k;
    }
  }
}

// Where nothing is interpolated they do not even differ in that: the gradient and its pattern go on from tile to tile.
TEST(Tiles, ShareOneBackground) {
  const test::DrawnSheet sheet = test::wavy_sheet();
  Settings settings = test::sheet_settings();
  settings.ground = false;
  MeshRenderer whole(settings, {}, sheet.bounds), tiled(settings, {}, sheet.bounds, {.tiles = {.pixels = 5000}});
  const Picture bare = whole.draw(View::textured, {});
  EXPECT_EQ(share_that_differs(bare, tiled.draw(View::textured, {}), 0.0f), 0.0);
}

}  // namespace
}  // namespace billow::render
