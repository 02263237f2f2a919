#include "render/frame/mesh_renderer.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "render/image/colour_map.h"
#include "render/image/compare.h"
#include "render/image/png.h"
#include "tests/support/drawn_sheet.h"
#include "tests/support/golden.h"
#include "tests/support/mesh_files.h"

namespace billow::render {
namespace {

using test::draw_sheet;
using test::flat_sheet;
using test::frontal_settings;
using test::sheet_settings;
using test::wavy_sheet;

std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::uint8_t* p = image.row(y) + 3 * x;
  return {p[0], p[1], p[2]};
}

std::array<int, 3> centre(const Image& image) { return pixel(image, image.width / 2, image.height / 2); }

int byte_of(double linear) {
  return static_cast<int>(std::lround(255.0 * (1.055 * std::pow(linear, 1.0 / 2.4) - 0.055)));
}

Image drawn(MeshRenderer& renderer, View view, const std::vector<sim::SurfaceState>& bodies) {
  return std::get<Image>(renderer.draw(view, bodies));
}

double luminance(const std::array<int, 3>& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

Settings with(Settings settings, const std::function<void(Settings&)>& change) {
  change(settings);
  return settings;
}

TEST(MeshRenderer, DrawsTheTexturedSheet) {
  EXPECT_GOLDEN(draw_sheet(wavy_sheet(), View::textured, sheet_settings()), "sheet_textured");
}

TEST(MeshRenderer, DrawsTheVelocityComponents) {
  const Settings settings = with(sheet_settings(), [](Settings& s) { s.legend = true; });
  EXPECT_GOLDEN(draw_sheet(wavy_sheet(), View::velocity, settings), "sheet_velocity_components");
}

TEST(MeshRenderer, DrawsTheSpeed) {
  const Settings settings = with(sheet_settings(), [](Settings& s) {
    s.velocity_colour = VelocityColour::magnitude;
    s.velocity_range = 1.5;
    s.legend = true;
  });
  EXPECT_GOLDEN(draw_sheet(wavy_sheet(), View::velocity, settings), "sheet_velocity_magnitude");
}

TEST(MeshRenderer, DrawsItsBackSide) {
  const Settings settings = with(sheet_settings(), [](Settings& s) {
    s.camera.fitted = false;
    s.camera.eye = {-0.6, 0.4, -2.0};
  });
  EXPECT_GOLDEN(draw_sheet(wavy_sheet(), View::textured, settings), "sheet_back");
}

TEST(MeshRenderer, DrawsClosedBodiesInOpenWaterWithoutGround) {
  const Settings settings = with(sheet_settings(), [](Settings& s) {
    s.ground = false;
    s.background.top = {0.10f, 0.30f, 0.40f}, s.background.bottom = {0.01f, 0.05f, 0.12f};
  });
  EXPECT_GOLDEN(draw_sheet(wavy_sheet(), View::textured, settings), "sheet_in_water");
}

// What the tolerance is for: a frame moved by one pixel must not pass.
TEST(MeshRenderer, AShiftByOnePixelFailsTheGoldenRule) {
  for (const View view : {View::textured, View::velocity, View::normal, View::id}) {
    const Image frame = draw_sheet(wavy_sheet(), view, sheet_settings());
    Image right = frame, down = frame;
    for (int y = 0; y < frame.height; ++y) std::copy_n(frame.row(y), 3 * (frame.width - 1), right.row(y) + 3);
    for (int y = 1; y < frame.height; ++y) std::copy_n(frame.row(y - 1), 3 * frame.width, down.row(y));
    EXPECT_FALSE(within_tolerance(compare(frame, right))) << name(view);
    EXPECT_FALSE(within_tolerance(compare(frame, down))) << name(view);
  }
}

TEST(MeshRenderer, GivesTheSameBytesAgainAndFromAFreshRenderer) {
  const test::DrawnSheet sheet = wavy_sheet();
  MeshRenderer renderer(sheet_settings(), {sheet.body}, sheet.bounds);
  for (const View view : {View::textured, View::velocity}) {
    SCOPED_TRACE(name(view));
    const Image first = drawn(renderer, view, {sheet.state});
    EXPECT_EQ(drawn(renderer, view, {sheet.state}).pixels, first.pixels);
    EXPECT_EQ(draw_sheet(sheet, view, sheet_settings()).pixels, first.pixels);
    EXPECT_EQ(drawn(renderer, view, {sheet.state}).pixels, first.pixels);  // after another renderer came and went
  }
}

TEST(MeshRenderer, KeepsNothingOfTheFrameBefore) {
  const test::DrawnSheet sheet = wavy_sheet();
  sim::SurfaceState moved = sheet.state;
  moved.position.col(0).array() += 0.2f;
  MeshRenderer renderer(sheet_settings(), {sheet.body}, sheet.bounds);
  const Image first = drawn(renderer, View::textured, {sheet.state});
  const Image other = drawn(renderer, View::textured, {moved});
  EXPECT_GT(compare(first, other).max, 100);
  EXPECT_EQ(drawn(renderer, View::textured, {sheet.state}).pixels, first.pixels);
}

// A child process draws with `threads` into `file`: Mesa reads the number once per process.
void draw_with_threads(const char* threads, const std::filesystem::path& file) {
  const pid_t child = fork();
  if (child == 0) {
    const std::string filter = "--gtest_filter=MeshRendererChild.*";
    setenv("LP_NUM_THREADS", threads, 1);
    setenv("BILLOW_CHILD_OUTPUT", file.c_str(), 1);
    execl("/proc/self/exe", "render_tests", filter.c_str(), "--gtest_brief=1", "--gtest_also_run_disabled_tests",
          nullptr);
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(MeshRendererChild, DISABLED_DrawsIntoTheFileItIsGiven) {
  const char* file = std::getenv("BILLOW_CHILD_OUTPUT");
  if (file) write_png(file, draw_sheet(wavy_sheet(), View::textured, sheet_settings()));
}

TEST(MeshRenderer, DrawsTheSamePixelsWithAnyNumberOfThreads) {
  const test::TemporaryFolder folder;
  for (const char* threads : {"0", "1", "7"})
    draw_with_threads(threads, folder.path() / (std::string(threads) + ".png"));
  const Image one = read_png(folder.path() / "1.png");
  EXPECT_EQ(read_png(folder.path() / "0.png").pixels, one.pixels);
  EXPECT_EQ(read_png(folder.path() / "7.png").pixels, one.pixels);
}

TEST(MeshRenderer, SurvivesAnUnknownGalliumDriver) {
  setenv("GALLIUM_DRIVER", "no_such_driver", 1);
  EXPECT_NE(draw_sheet(flat_sheet(), View::velocity, frontal_settings()).pixels.size(), 0u);
  unsetenv("GALLIUM_DRIVER");
}

// A sheet that faces the eye is not darkened: its colour is the colour map's, to the rounding of the sRGB encoding.
TEST(MeshRenderer, ShowsVelocitiesInTheColoursOfTheMap) {
  const Settings settings = with(frontal_settings(), [](Settings& s) { s.velocity_range = 2.0; });
  for (const Eigen::Vector3f& v :
       {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, -1, 2), Eigen::Vector3f(-1.9f, 0.3f, -9)}) {
    const Rgb8 wanted = velocity_rgb(v.cast<double>(), 2.0);
    const auto seen = centre(draw_sheet(flat_sheet(v), View::velocity, settings));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], wanted[c], 1) << v.transpose();
  }
}

// With velocity_shading 0 every pixel that a body fills holds round(255 (1/2 + 1/2 v / v_max)) itself, turned or not.
TEST(MeshRenderer, ShowsVelocitiesExactlyWithoutShading) {
  const Settings settings = with(frontal_settings(), [](Settings& s) {
    s.velocity_range = 2.0;
    s.velocity_shading = 0.0;
  });
  for (int k = -20; k <= 20; ++k) {
    test::DrawnSheet sheet = flat_sheet({0.1f * k, -0.037f * k, 0.0f});
    sheet.state.position.col(2) = 0.5f * sheet.state.position.col(0);
    const Image seen = draw_sheet(sheet, View::velocity, settings);
    const std::array<int, 3> wanted = {static_cast<int>(std::lround(255.0 * (0.5 + 0.5 * double(0.1f * k) / 2.0))),
                                       static_cast<int>(std::lround(255.0 * (0.5 + 0.5 * double(-0.037f * k) / 2.0))),
                                       128};
    for (int x = 22; x < 42; ++x) EXPECT_EQ(pixel(seen, x, 25), wanted) << k << " at " << x;
  }
}

TEST(MeshRenderer, ShowsSpeedsInTheColoursOfTheMap) {
  const Settings settings = with(frontal_settings(), [](Settings& s) {
    s.velocity_range = 2.0;
    s.velocity_colour = VelocityColour::magnitude;
  });
  for (const float speed : {0.0f, 0.7f, 1.3f, 2.0f, 5.0f}) {
    const Rgb8 wanted = magnitude_rgb(speed / 2.0);
    const auto seen = centre(draw_sheet(flat_sheet({0, speed, 0}), View::velocity, settings));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], wanted[c], 1) << speed;
  }
}

// Turned by 60 degrees the surface faces the eye by 1/2: darkened by shading / 2 in linear light, and not at all at 0.
TEST(MeshRenderer, DarkensTurnedVelocitiesByWhatTheSettingSays) {
  test::DrawnSheet sheet = flat_sheet({0.5f, 0.5f, 0.5f});
  sheet.state.position.col(2) = std::sqrt(3.0f) * sheet.state.position.col(0);
  for (const double shading : {0.0, 0.25}) {
    const Settings settings = with(frontal_settings(), [&](Settings& s) {
      s.velocity_shading = shading;
      s.velocity_range = 1.0;
    });
    const double linear = std::pow((0.75 + 0.055) / 1.055, 2.4) * (1.0 - 0.5 * shading);
    EXPECT_NEAR(centre(draw_sheet(sheet, View::velocity, settings))[0], byte_of(linear), 2) << shading;
  }
}

// Half black, half white along a vertical edge through the middle of a pixel column: the mean of linear light is
// sRGB 188, the mean of the encoded values would be 128.
TEST(MeshRenderer, AveragesSamplesInLinearLight) {
  test::DrawnSheet sheet = flat_sheet({9, 9, 9});
  sheet.state.position.col(0).array() += 1.0f + 2.0f / 64.0f;  // the left edge half a pixel right of the middle
  for (const int samples : {4, 16}) {
    const Settings settings = with(frontal_settings(), [&](Settings& s) { s.samples = samples; });
    const Image white_on_grey = draw_sheet(sheet, View::velocity, settings);
    const double back = pixel(white_on_grey, 5, 5)[0] / 255.0, linear = std::pow((back + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(pixel(white_on_grey, 32, 32)[0], byte_of(0.5 + 0.5 * linear), 2) << samples;
  }
}

TEST(MeshRenderer, EncodesALinearBackgroundAsSrgb) {
  const Settings settings = with(frontal_settings(), [](Settings& s) {
    s.background.top = s.background.bottom = {0.5f, 0.2f, 0.02f};
  });
  const auto seen = pixel(draw_sheet(flat_sheet(), View::textured, settings), 2, 2);
  EXPECT_NEAR(seen[0], byte_of(0.5), 1);
  EXPECT_NEAR(seen[1], byte_of(0.2), 1);
  EXPECT_NEAR(seen[2], byte_of(0.02), 1);
}

TEST(MeshRenderer, SmoothsEdgesMoreWithMoreSamples) {
  const Image reference =
      draw_sheet(wavy_sheet(), View::velocity, with(sheet_settings(), [](Settings& s) { s.samples = 16; }));
  double last = 1e9;
  for (const int samples : {1, 4}) {
    const Image image =
        draw_sheet(wavy_sheet(), View::velocity, with(sheet_settings(), [&](Settings& s) { s.samples = samples; }));
    EXPECT_LT(compare(image, reference).rmse, last) << samples;
    last = compare(image, reference).rmse;
  }
  EXPECT_GT(last, 0.0);
}

TEST(MeshRenderer, ShowsBothSidesAndTheBackDarker) {
  const auto front = centre(draw_sheet(flat_sheet(), View::textured, frontal_settings()));
  test::DrawnSheet turned = flat_sheet();
  turned.body.surface.triangle.col(1).swap(turned.body.surface.triangle.col(2));
  const auto back = centre(draw_sheet(turned, View::textured, frontal_settings()));
  EXPECT_LT(luminance(back), luminance(front));
  EXPECT_GT(luminance(back), 0.6 * luminance(front));
}

// A sheet between the key light and another one takes the light from it.
TEST(MeshRenderer, CastsShadowsOnOtherBodies) {
  const test::DrawnSheet wall = flat_sheet();
  test::DrawnSheet blocker = flat_sheet();
  blocker.state.position *= 0.4f;
  blocker.state.position.rowwise() += Eigen::RowVector3f(-0.95f, 1.2f, 0.55f);  // towards the key light, out of sight
  RunBounds bounds = wall.bounds;
  for (Eigen::Index p = 0; p < 9; ++p)
    bounds.box.extend(Eigen::Vector3d(blocker.state.position.row(p).transpose().cast<double>()));
  MeshRenderer alone(frontal_settings(), {wall.body}, bounds);
  MeshRenderer both(frontal_settings(), {wall.body, blocker.body}, bounds);
  const auto lit = centre(drawn(alone, View::textured, {wall.state}));
  const auto shaded = centre(drawn(both, View::textured, {wall.state, blocker.state}));
  EXPECT_LT(luminance(shaded), 0.8 * luminance(lit));
}

TEST(MeshRenderer, CastsAShadowOnTheGround) {
  const test::DrawnSheet sheet = wavy_sheet();
  const Image with_ground = draw_sheet(sheet, View::textured, sheet_settings());
  MeshRenderer empty(sheet_settings(), {}, sheet.bounds);
  const Image bare = drawn(empty, View::textured, {});
  // To the lower right of the sheet, where the light from the upper left throws it, and nowhere in the upper left.
  int darker = 0;
  for (int y = 150; y < 240; ++y)
    for (int x = 200; x < 320; ++x) darker += luminance(pixel(bare, x, y)) - luminance(pixel(with_ground, x, y)) > 20;
  EXPECT_GT(darker, 300);
  EXPECT_EQ(pixel(with_ground, 10, 10), pixel(bare, 10, 10));
}

TEST(MeshRenderer, HidesWhatIsBelowTheGround) {
  const Settings high = with(sheet_settings(), [](Settings& s) { s.ground_height = 0.0; });
  const test::DrawnSheet sheet = wavy_sheet();
  MeshRenderer empty(high, {}, sheet.bounds);
  const Image bare = drawn(empty, View::textured, {});
  test::DrawnSheet sunk = sheet;
  sunk.state.position.col(1).array() -= 3.0f;
  MeshRenderer renderer(high, {sunk.body}, sheet.bounds);
  EXPECT_LE(compare(drawn(renderer, View::textured, {sunk.state}), bare).max, 1);
}

TEST(MeshRenderer, DrawsPlainColourWithoutATexture) {
  test::DrawnSheet sheet = flat_sheet();
  sheet.body.finish[0].colour = {0.8f, 0.1f, 0.1f};
  const auto seen = centre(draw_sheet(sheet, View::textured, frontal_settings()));
  EXPECT_GT(seen[0], 2 * seen[1]);
}

TEST(MeshRenderer, DrawsASceneOutOfSightAndOneAroundTheEye) {
  test::DrawnSheet sheet = flat_sheet();
  sheet.state.position.col(1).array() += 100.0f;
  EXPECT_EQ(draw_sheet(sheet, View::velocity, frontal_settings()).width, 64);
  sheet = flat_sheet();
  sheet.state.position.col(2).array() = 10.0f * sheet.state.position.col(0).array();  // one side behind the eye
  EXPECT_EQ(draw_sheet(sheet, View::textured, frontal_settings()).width, 64);
}

TEST(MeshRenderer, LaysTheLegendOverTheVelocityViewAlone) {
  const test::DrawnSheet sheet = wavy_sheet();
  const Settings labelled = with(sheet_settings(), [](Settings& s) { s.legend = true; });
  for (const View view : {View::textured, View::velocity, View::normal, View::id}) {
    const Image with_legend = draw_sheet(sheet, view, labelled), without = draw_sheet(sheet, view, sheet_settings());
    EXPECT_EQ(with_legend.pixels != without.pixels, view == View::velocity) << name(view);
  }
}

// A speck before the sheet: seen in every view but the velocities, and there not even as a hole, exact colours or not.
TEST(MeshRenderer, LeavesSceneryOutOfTheVelocityView) {
  const test::DrawnSheet sheet = flat_sheet({0.5f, 0.0f, 0.0f});
  test::DrawnSheet speck = flat_sheet({0.0f, 1.0f, 0.0f});
  speck.state.position *= 0.2f;
  speck.state.position.col(2).array() = 0.5f;
  speck.body.scenery = true;
  speck.body.finish[0].colour = {0.8f, 0.1f, 0.1f};
  for (const double shading : {0.25, 0.0}) {
    const Settings settings = with(frontal_settings(), [&](Settings& s) { s.velocity_shading = shading; });
    MeshRenderer renderer(settings, {sheet.body, speck.body}, sheet.bounds);
    for (const View view : {View::textured, View::velocity, View::id}) {
      const Image with_speck = drawn(renderer, view, {sheet.state, speck.state});
      EXPECT_EQ(with_speck.pixels == draw_sheet(sheet, view, settings).pixels, view == View::velocity) << name(view);
    }
  }
}

TEST(MeshRenderer, RefusesSizesThatCannotBeDrawnAndStatesThatDoNotFit) {
  const test::DrawnSheet sheet = flat_sheet();
  const auto make = [&](int width, int height, int samples) {
    MeshRenderer(with(sheet_settings(), [&](Settings& s) { s.width = width, s.height = height, s.samples = samples; }),
                 {sheet.body}, sheet.bounds);
  };
  EXPECT_THROW(make(1 << 20, 4, 1), InputError);
  EXPECT_THROW(make(12000, 4, 16), InputError);  // drawn at twice the size
  EXPECT_THROW(make(0, 4, 1), InputError);
  MeshRenderer renderer(frontal_settings(), {sheet.body}, sheet.bounds);
  EXPECT_THROW(renderer.draw(View::velocity, {}), std::invalid_argument);
  EXPECT_THROW(renderer.draw(View::velocity, {sim::SurfaceState()}), std::invalid_argument);
  EXPECT_THROW(renderer.draw(static_cast<View>(-1), {sheet.state}), std::logic_error);
}

TEST(MeshRenderer, SaysWhatItUses) {
  const test::DrawnSheet sheet = flat_sheet();
  const Settings given = with(frontal_settings(), [](Settings& s) { s.velocity_range = 7.0; });
  MeshRenderer renderer(given, {sheet.body}, sheet.bounds);
  EXPECT_EQ(renderer.velocity_range(), 7.0);
  EXPECT_NE(renderer.description().find("OpenGL"), std::string::npos);
  MeshRenderer found(frontal_settings(), {sheet.body}, {sheet.bounds.box, 3.5});
  EXPECT_EQ(found.velocity_range(), 3.5);
}

}  // namespace
}  // namespace billow::render
