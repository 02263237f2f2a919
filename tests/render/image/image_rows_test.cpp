// Values as files keep them.
#include "render/image/image_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "render/image/exr.h"
#include "render/image/png.h"
#include "tests/support/mesh_files.h"
#include "tests/support/png_bytes.h"
#include "tests/support/tool.h"

namespace billow::render {
namespace {

using test::png_bytes;
using testing::ElementsAre;
using testing::HasSubstr;

class Rows : public testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

  // The first row's values, a pixel's channels next to one another.
  std::vector<double> values(const std::string& name) const {
    ImageRows rows(path(name));
    const ValueRow& row = rows.next();
    std::vector<double> all;
    for (Eigen::Index x = 0; x < row.rows(); ++x)
      for (Eigen::Index c = 0; c < row.cols(); ++c) all.push_back(row(x, c));
    return all;
  }

  std::string fault(const std::string& name) const {
    try {
      ImageRows rows(path(name));
      for (int y = 0; y < rows.shape().height; ++y) rows.next();
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  static DataImage data(int width, int height, std::initializer_list<const char*> names) {
    DataImage image{width, height, {}};
    float value = 0.0f;
    for (const char* name : names) {
      image.channels.push_back({name, std::vector<float>(static_cast<std::size_t>(width) * height)});
      for (float& v : image.channels.back().value) v = value += 0.25f;
    }
    return image;
  }

  test::TemporaryFolder folder_;
};

TEST_F(Rows, KeepPngValuesAsTheyAre) {
  folder_.write("rgb16.png",
                png_bytes({.width = 1, .depth = 16, .colour_type = 2}, std::string("\x10\x11\0\1\xff\xff", 6)));
  EXPECT_THAT(values("rgb16.png"), ElementsAre(0x1011, 1, 65535));
  folder_.write("grey16.png", png_bytes({.width = 1, .depth = 16, .colour_type = 4}, std::string("\0\2\0\3", 4)));
  EXPECT_THAT(values("grey16.png"), ElementsAre(2, 2, 2, 3));
  folder_.write("interlaced16.png", png_bytes({.width = 1, .height = 2, .depth = 16, .colour_type = 0, .interlace = 1},
                                              std::string("\0\2\0\3", 4)));
  EXPECT_THAT(values("interlaced16.png"), ElementsAre(2, 2, 2));
  folder_.write("grey2.png", png_bytes({.width = 4, .depth = 2, .colour_type = 0}, "\x1b"));
  EXPECT_THAT(values("grey2.png"), ElementsAre(0, 0, 0, 85, 85, 85, 170, 170, 170, 255, 255, 255));
}

TEST_F(Rows, GiveOpenExrsChannelsByName) {
  write_exr(path("a.exr"), data(2, 3, {"Z", "velocity.X"}));
  ImageRows rows(path("a.exr"));
  EXPECT_EQ(rows.shape().width, 2);
  EXPECT_EQ(rows.shape().height, 3);
  EXPECT_EQ(rows.shape().depth, Depth::floats);
  EXPECT_EQ(rows.shape().channels[1].name, "velocity.X");
  EXPECT_FALSE(rows.shape().colours());
  rows.next();
  const ValueRow& second = rows.next();
  EXPECT_EQ(second(1, 0), 1.0);
  EXPECT_EQ(second(1, 1), 2.5);
}

TEST_F(Rows, TakeHashesOfNamesForIdentities) {
  DataImage image = data(1, 1, {"id00.G", "id00.R", "id01.B", "identity.R"});
  image.notes = {{"cryptomatte/1234567/name", "id"}};
  write_exr(path("a.exr"), image);
  std::vector<Meaning> meaning;
  const ImageRows rows(path("a.exr"));
  for (const RowChannel& channel : rows.shape().channels) meaning.push_back(channel.meaning);
  EXPECT_THAT(meaning, ElementsAre(Meaning::quantity, Meaning::hash, Meaning::hash, Meaning::quantity));
}

TEST_F(Rows, SayWhatIsWrongWithAnOpenExrFile) {
  write_exr(path("a.exr"), data(64, 64, {"R", "G", "B"}));
  const std::string whole = test::read_text(path("a.exr"));
  EXPECT_EQ(fault("a.exr"), "");
  EXPECT_THAT(fault("none.exr"), HasSubstr("none.exr: cannot open the image: No such file"));
  folder_.write("b.exr", "");
  EXPECT_THAT(fault("b.exr"), HasSubstr("b.exr: the image is empty"));
  folder_.write("b.exr", "no image at all");
  EXPECT_THAT(fault("b.exr"), HasSubstr("b.exr: is no OpenEXR image"));
  folder_.write("b.exr", whole.substr(0, whole.size() - 10));
  EXPECT_THAT(fault("b.exr"), HasSubstr("damaged in its row 48"));
  ASSERT_EQ(mkfifo(path("pipe.exr").c_str(), 0600), 0);
  EXPECT_THAT(fault("pipe.exr"), HasSubstr("is not a regular file"));
}

// No flipped byte is worse than a message: the header's claims first of all.
TEST_F(Rows, SurviveEveryFlippedByteOfAnOpenExrFile) {
  write_exr(path("a.exr"), data(20, 20, {"R", "G"}));
  const std::string whole = test::read_text(path("a.exr"));
  for (std::size_t k = 0; k < std::min<std::size_t>(whole.size(), 500); ++k)
    for (const char flip : {'\x80', '\x7f', '\x01'}) {
      std::string bad = whole;
      bad[k] = static_cast<char>(bad[k] ^ flip);
      folder_.write("b.exr", bad);
      const std::string said = fault("b.exr");
      EXPECT_TRUE(said.empty() || said.find("b.exr: ") != std::string::npos) << k << said;
    }
}

TEST_F(Rows, RefuseAnOpenExrImageTooLargeToHold) {
  write_exr(path("a.exr"), data(8193, 1, {"Z"}));
  EXPECT_THAT(fault("a.exr"), HasSubstr("8193 x 1 pixels; at most 8192 x 8192"));
  std::string bytes = test::read_text(path("a.exr"));
  const std::size_t window = bytes.find("dataWindow");
  bytes.replace(window + std::string("dataWindow\0box2i\0....", 21).size() + 8, 4, "\xff\xff\xff\x3f");
  folder_.write("b.exr", bytes);
  EXPECT_NE(fault("b.exr"), "");
}

TEST_F(Rows, PairChannelsByName) {
  write_exr(path("a.exr"), data(1, 1, {"B", "G", "R"}));
  write_exr(path("alpha.exr"), data(1, 1, {"R", "A", "B", "G"}));
  ImagePair pair(path("a.exr"), path("alpha.exr"));
  ASSERT_FALSE(pair.mismatch());
  pair.next();
  for (Eigen::Index c = 0; c < 4; ++c)
    if (pair.shape().channels[c].name == "A") {
      EXPECT_EQ(pair.a()(0, c), 1.0);  // opaque
      EXPECT_EQ(pair.b()(0, c), 0.5);
    }
  write_exr(path("more.exr"), data(1, 1, {"R", "G", "B", "Z"}));
  EXPECT_THAT(*ImagePair(path("a.exr"), path("more.exr")).mismatch(), HasSubstr("channel Z only in"));
  write_png(path("a.png"), Image(1, 1));
  EXPECT_THROW(ImagePair(path("a.exr"), path("a.png")), InputError);
}

TEST_F(Rows, PutEightBitsOnTheScaleOfSixteen) {
  folder_.write("8.png", png_bytes({.width = 1}, "\x01\x02\xff"));
  folder_.write("16.png", png_bytes({.width = 1, .depth = 16}, std::string("\1\1\2\2\xff\xff", 6)));
  ImagePair pair(path("8.png"), path("16.png"));
  EXPECT_EQ(pair.note(), "8 against 16 bits");
  pair.next();
  EXPECT_TRUE((pair.a() == pair.b()).all());
}

TEST(SeenRow, EncodesFloatsAndClampsThem) {
  const RowShape shape{4, 1, 0, 0, Depth::floats, {{"Y"}}};
  ValueRow row(4, 1);
  row << 0.0, 0.2158605, 7.0, std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(seen_row(shape, row), ElementsAre(0, 0, 0, 128, 128, 128, 255, 255, 255, 0, 0, 0));
}

}  // namespace
}  // namespace billow::render
