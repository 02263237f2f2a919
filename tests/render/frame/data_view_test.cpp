// The numbers of the data view, against closed forms of a sheet before a known camera.
#include <gtest/gtest.h>

#include <cmath>

#include "render/frame/mesh_renderer.h"
#include "render/image/cryptomatte.h"
#include "render/image/exr.h"
#include "tests/support/drawn_sheet.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow::render {
namespace {

using test::DrawnSheet;
using test::flat_sheet;
using test::frontal_settings;
using test::sheet_settings;
using test::wavy_sheet;

// frontal_settings(): 64 pixels each way from z = 2 m, 45 degrees up and down.
constexpr double focal = 32.0, eye_z = 2.0;

DataImage data_of(const Settings& settings, const std::vector<DrawnBody>& bodies, const RunBounds& bounds,
                  const std::vector<sim::SurfaceState>& states,
                  const Eigen::Vector3d& camera_velocity = Eigen::Vector3d::Zero()) {
  MeshRenderer renderer(settings, bodies, bounds);
  return std::get<DataImage>(renderer.draw(View::data, states, camera_velocity));
}

DataImage data_of(const DrawnSheet& sheet, const Settings& settings) {
  return data_of(settings, {sheet.body}, sheet.bounds, {sheet.state});
}

const std::vector<float>& channel(const DataImage& image, const std::string& name) {
  for (const DataImage::Channel& c : image.channels)
    if (c.name == name) return c.value;
  throw std::runtime_error("no channel " + name);
}

Settings one_sample(Settings settings) {
  settings.samples = 1;
  return settings;
}

// The ray through the middle of a pixel, at depth 1, from frontal_settings()' eye.
Eigen::Vector3d ray(int x, int y) { return {(x + 0.5 - 32.0) / focal, (32.0 - y - 0.5) / focal, -1.0}; }

TEST(DataView, ARigidlyMovingBodyReadsBackItsVelocity) {
  const Eigen::Vector3f v(0.3f, -1.7f, 0.9f);
  DrawnSheet sheet = wavy_sheet();
  sheet.state.velocity.rowwise() = v.transpose();
  for (const int samples : {1, 4, 16}) {
    Settings settings = sheet_settings();
    settings.samples = samples;
    const DataImage image = data_of(sheet, settings);
    const std::vector<float>& a = channel(image, "A");
    int edges = 0, filled = 0;
    for (std::size_t p = 0; p < a.size(); ++p) {
      for (int c = 0; c < 3; ++c) {
        const float value = channel(image, std::string("velocity.") + "XYZ"[c])[p];
        if (a[p] == 0.0f)
          EXPECT_EQ(value, 0.0f);
        else
          EXPECT_NEAR(value / a[p], v[c], 1e-6);
      }
      filled += a[p] == 1.0f;
      edges += a[p] > 0.0f && a[p] < 1.0f;
    }
    EXPECT_GT(filled, 5000);
    EXPECT_EQ(edges > 100, samples > 1) << samples;
  }
}

// From where the point is seen to where the same point is seen one frame later, both projected here.
TEST(DataView, MotionIsTheProjectedDisplacement) {
  const Eigen::Vector3f v(0.9f, -0.4f, 3.0f);
  DrawnSheet sheet = flat_sheet(v);
  sheet.state.position.col(2) = 0.3f * sheet.state.position.col(0);
  const Settings settings = one_sample(frontal_settings());
  const DataImage image = data_of(sheet, settings);
  int seen = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::size_t p = std::size_t(64) * y + x;
      if (channel(image, "A")[p] == 0.0f) continue;
      const Eigen::Vector3d now = channel(image, "Z")[p] * ray(x, y), then = now + v.cast<double>() / settings.fps;
      const Eigen::Vector2d way = focal * (then.head<2>() / -then.z() - now.head<2>() / -now.z());
      EXPECT_NEAR(channel(image, "motion.X")[p], way.x(), 1e-5);
      EXPECT_NEAR(channel(image, "motion.Y")[p], way.y(), 1e-5);
      ++seen;
    }
  EXPECT_GT(seen, 700);
}

TEST(DataView, ABodyThatTheCameraGoesAlongWithDoesNotMoveInThePicture) {
  const DrawnSheet sheet = flat_sheet({2.0f, 1.0f, -0.5f});
  const DataImage image =
      data_of(frontal_settings(), {sheet.body}, sheet.bounds, {sheet.state}, Eigen::Vector3d(2.0, 1.0, -0.5));
  const std::size_t middle = 64 * 32 + 32;
  EXPECT_EQ(channel(image, "motion.X")[middle], 0.0f);
  EXPECT_EQ(channel(image, "motion.Y")[middle], 0.0f);
  EXPECT_EQ(channel(image, "velocity.X")[middle], 2.0f);
}

// z = s x meets the ray t (r_x, r_y, -1) from z = 2 at depth t = 2 / (1 + s r_x); its normal is (-s, 0, 1) normalised.
TEST(DataView, DepthAndNormalsOfAPlaneAreRight) {
  for (const bool turned : {false, true}) {
    const double slope = 0.7;
    DrawnSheet sheet = flat_sheet();
    sheet.state.position.col(2) = static_cast<float>(slope) * sheet.state.position.col(0);
    if (turned) sheet.body.surface.triangle.col(1).swap(sheet.body.surface.triangle.col(2));
    const DataImage image = data_of(sheet, one_sample(frontal_settings()));
    const Eigen::Vector3d normal = Eigen::Vector3d(-slope, 0.0, 1.0).normalized();
    int seen = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const std::size_t p = std::size_t(64) * y + x;
        if (channel(image, "A")[p] == 0.0f) {
          EXPECT_EQ(channel(image, "Z")[p], std::numeric_limits<float>::infinity());
          continue;
        }
        const double depth = eye_z / (1.0 + slope * ray(x, y).x()), u = 0.5 + 0.5 * depth * ray(x, y).x();
        EXPECT_NEAR(channel(image, "Z")[p], depth, 1e-6);
        EXPECT_NEAR(channel(image, "N.X")[p], normal.x(), 1e-6);
        EXPECT_NEAR(channel(image, "N.Y")[p], 0.0, 1e-6);
        EXPECT_NEAR(channel(image, "N.Z")[p], normal.z(), 1e-6);
        EXPECT_NEAR(channel(image, "UV.U")[p], u, 1e-6);
        ++seen;
      }
    EXPECT_GT(seen, 700);
  }
}

TEST(DataView, ColoursAreUnlitAndPremultiplied) {
  DrawnSheet sheet = flat_sheet();
  sheet.body.finish[0].colour = {0.8f, 0.25f, 0.1f};
  Settings settings = frontal_settings();
  settings.samples = 4;
  sheet.state.position.col(0).array() += 1.0f / focal;  // an edge through the middle of a column
  const DataImage image = data_of(sheet, settings);
  for (const std::size_t p : {std::size_t(64 * 32 + 32), std::size_t(64 * 32 + 16)}) {
    const float a = channel(image, "A")[p];
    EXPECT_NEAR(channel(image, "R")[p], 0.8f * a, 1e-6);
    EXPECT_NEAR(channel(image, "G")[p], 0.25f * a, 1e-6);
    EXPECT_NEAR(channel(image, "B")[p], 0.1f * a, 1e-6);
  }
  EXPECT_EQ(channel(image, "A")[64 * 32 + 32], 1.0f);
  EXPECT_EQ(channel(image, "A")[64 * 32 + 16], 0.5f);
}

TEST(DataView, CarriesStrainPerPoint) {
  DrawnSheet sheet = flat_sheet();
  EXPECT_EQ(channel(data_of(sheet, frontal_settings()), "strain")[64 * 32 + 32], 0.0f);
  sheet.state.strain = Eigen::VectorXf::Constant(sheet.state.position.rows(), 0.125f);
  EXPECT_NEAR(channel(data_of(sheet, frontal_settings()), "strain")[64 * 32 + 32], 0.125f, 1e-7);
}

// Two sheets that meet in the middle of a column of pixels: each has half of those.
TEST(DataView, SharesAPixelBetweenBodiesAsCryptomatte) {
  DrawnSheet left = flat_sheet(), right = flat_sheet();
  left.state.position.col(0).array() += -1.0f + 1.0f / focal;
  right.state.position.col(0).array() += 1.0f + 1.0f / focal;
  left.body.name = "left";
  right.body.name = "right";
  const DataImage image = data_of(frontal_settings(), {left.body, right.body}, left.bounds, {left.state, right.state});
  const std::size_t row = 64 * 32;
  EXPECT_EQ(channel(image, "id00.R")[row + 20], cryptomatte_id("left"));
  EXPECT_EQ(channel(image, "id00.G")[row + 20], 1.0f);
  EXPECT_EQ(channel(image, "id00.A")[row + 20], 0.0f);
  EXPECT_EQ(channel(image, "id00.R")[row + 44], cryptomatte_id("right"));
  EXPECT_EQ(channel(image, "id00.R")[row + 32], cryptomatte_id("left"));
  EXPECT_EQ(channel(image, "id00.B")[row + 32], cryptomatte_id("right"));
  EXPECT_EQ(channel(image, "id00.G")[row + 32], 0.5f);
  EXPECT_EQ(channel(image, "id00.A")[row + 32], 0.5f);
  for (std::size_t p = 0; p < 64 * 64; ++p)
    EXPECT_EQ(channel(image, "id00.G")[p] + channel(image, "id00.A")[p], channel(image, "A")[p]);
}

// Bands of the picture fit together: a picture of several looks as one of a single band does where they agree.
TEST(DataView, IsTheSameInPicturesOfSeveralBands) {
  Settings settings = sheet_settings();
  settings.samples = 16;
  settings.width = 1280;
  settings.height = 960;  // 51 rows at a time
  const DrawnSheet sheet = flat_sheet();
  const DataImage image = data_of(sheet, settings);
  const std::vector<float>& a = channel(image, "A");
  const std::vector<float>& v = channel(image, "UV.V");
  for (int y = 1; y < settings.height; ++y) {
    const std::size_t p = std::size_t(settings.width) * y + 640;
    if (a[p] == 1.0f && a[p - settings.width] == 1.0f) {
      EXPECT_LT(v[p], v[p - settings.width]) << y;
    }
  }
}

TEST(DataView, GivesTheSameFileAgain) {
  const test::TemporaryFolder folder;
  const DrawnSheet sheet = wavy_sheet();
  std::vector<std::string> files;
  for (const char* name : {"a.exr", "b.exr"}) {
    write_exr(folder.path() / name, data_of(sheet, sheet_settings()));
    files.push_back(test::read_text(folder.path() / name));
  }
  EXPECT_GT(files[0].size(), 1000u);
  EXPECT_EQ(files[0], files[1]);
}

// near and far stand in the file: z = far - (code - 1) / 65534 (far - near).
TEST(DepthView, CodesDepthSoThatItCanBeReadBack) {
  DrawnSheet sheet = flat_sheet();
  sheet.state.position.col(2) = 0.7f * sheet.state.position.col(0);
  sheet.bounds.box.extend(Eigen::Vector3d(0, 0, -0.8)).extend(Eigen::Vector3d(0, 0, 0.8));
  const Settings settings = one_sample(frontal_settings());
  MeshRenderer renderer(settings, {sheet.body}, sheet.bounds);
  const auto seen = std::get<Image16>(renderer.draw(View::depth, {sheet.state}));
  const DataImage data = data_of(sheet, settings);
  ASSERT_EQ(seen.notes.size(), 2u);
  const double near = std::stod(seen.notes[0].second), far = std::stod(seen.notes[1].second);
  EXPECT_NEAR(near, eye_z - 0.8, 1e-12);
  EXPECT_NEAR(far, eye_z + 0.8, 1e-12);
  for (std::size_t p = 0; p < seen.pixels.size(); ++p) {
    EXPECT_EQ(seen.pixels[p] == 0, channel(data, "A")[p] == 0.0f);
    if (seen.pixels[p] != 0) {
      EXPECT_NEAR(far - (seen.pixels[p] - 1) / 65534.0 * (far - near), channel(data, "Z")[p], 1e-4 * (far - near));
    }
  }
}

TEST(NormalView, CodesTheSideThatTheEyeSees) {
  const Image seen = test::draw_sheet(flat_sheet(), View::normal, frontal_settings());
  const std::uint8_t* middle = seen.row(32) + 3 * 32;
  EXPECT_EQ(middle[0], 128);
  EXPECT_EQ(middle[1], 128);
  EXPECT_EQ(middle[2], 255);
  EXPECT_EQ(seen.row(2)[6] + seen.row(2)[7] + seen.row(2)[8], 0);
}

TEST(IdView, GivesEveryBodyOneColourWithoutMixtures) {
  DrawnSheet left = flat_sheet(), right = flat_sheet();
  left.state.position.col(0).array() += -1.0f + 1.0f / focal;
  right.state.position.col(0).array() += 1.0f + 1.0f / focal;
  MeshRenderer renderer(frontal_settings(), {left.body, right.body}, left.bounds);
  const auto seen = std::get<Image>(renderer.draw(View::id, {left.state, right.state}));
  std::vector<std::vector<int>> colours;
  for (int p = 0; p < 64 * 64; ++p) {
    const std::vector<int> colour(seen.pixels.begin() + 3 * p, seen.pixels.begin() + 3 * p + 3);
    if (std::find(colours.begin(), colours.end(), colour) == colours.end()) colours.push_back(colour);
  }
  EXPECT_EQ(colours.size(), 3u);  // black, and one each
}

}  // namespace
}  // namespace billow::render
