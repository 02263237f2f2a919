// What is found wrong with files of pictures, without decoding them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "render/image/exr.h"
#include "render/image/picture.h"
#include "render/image/png.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow::render {
namespace {

using testing::HasSubstr;

constexpr int width = 23, height = 37;

class PictureFault : public testing::Test {
 protected:
  PictureFault() {
    Image image(width, height, 4);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i * 31 + i / 7);
    write_png(path("good.png"), image);
    DataImage data{width, height, {{"R", {}}, {"Z", {}}}, {{"name", "value"}}};
    for (DataImage::Channel& channel : data.channels)
      for (int k = 0; k < width * height; ++k) channel.value.push_back(std::floor(0.1f * static_cast<float>(k)));
    write_exr(path("good.exr"), data);
  }

  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  std::string bytes_of(const std::string& name) const { return test::read_text(path(name)); }
  // Of a file of these bytes; "" for none.
  std::string fault(const std::string& name, const std::string& bytes) const {
    return picture_fault(folder_.write(name, bytes), width, height).value_or("");
  }

  test::TemporaryFolder folder_;
};

TEST_F(PictureFault, IsNoneOfWhatIsWritten) {
  EXPECT_EQ(fault("a.png", bytes_of("good.png")), "");
  EXPECT_EQ(fault("a.exr", bytes_of("good.exr")), "");
  write_png(path("grey.png"), Image16{width, height, std::vector<std::uint16_t>(width * height, 7), {{"key", "text"}}});
  EXPECT_EQ(fault("a.png", bytes_of("grey.png")), "");
  // Chunks and blocks larger than what is read at a time, and blocks that cannot be packed.
  Image large(1000, 700, 3);
  DataImage noise{300, 40, {{"R", {}}}};
  for (std::size_t k = 0; k < large.pixels.size(); ++k) large.pixels[k] = static_cast<std::uint8_t>(k * k >> 7);
  for (unsigned k = 0, seed = 1; k < 300 * 40; ++k) seed *= 48271, noise.channels[0].value.push_back(1.0f / seed);
  write_png(path("large.png"), large);
  write_exr(path("noise.exr"), noise);
  EXPECT_EQ(picture_fault(path("large.png"), 1000, 700), std::nullopt);
  EXPECT_EQ(picture_fault(path("noise.exr"), 300, 40), std::nullopt);
}

TEST_F(PictureFault, IsAnyFlippedByteOfAPng) {
  const std::string good = bytes_of("good.png");
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x55);
    EXPECT_NE(fault("a.png", bad), "") << "byte " << i;
  }
}

// A header's names have no checksum.
TEST_F(PictureFault, IsAnyFlippedByteOfAnExrsBlocks) {
  const std::string good = bytes_of("good.exr");
  // The header's last attribute has a name, a type, a size and a value; then come an end and the offsets of 3 blocks.
  const std::size_t blocks = good.find("screenWindowWidth") + 18 + 6 + 4 + 4 + 1 + 3 * 8;
  ASSERT_LT(blocks, good.size());
  for (std::size_t i = blocks; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x55);
    EXPECT_NE(fault("a.exr", bad), "") << "byte " << i << " of " << good.size();
  }
}

TEST_F(PictureFault, IsAnyEndThatIsMissing) {
  for (const char* kind : {"png", "exr"}) {
    const std::string good = bytes_of(std::string("good.") + kind);
    for (std::size_t size = 0; size < good.size(); ++size)
      EXPECT_NE(fault(std::string("a.") + kind, good.substr(0, size)), "") << kind << " of " << size << " bytes";
  }
}

TEST_F(PictureFault, SaysWhatItIs) {
  const std::string png = bytes_of("good.png"), exr = bytes_of("good.exr");
  EXPECT_EQ(fault("a.png", ""), "is empty");
  EXPECT_EQ(fault("a.png", std::string(png.size(), '\0')), "is not a PNG image");
  EXPECT_EQ(fault("a.png", png.substr(0, png.size() - 1)), "is cut short");
  EXPECT_EQ(fault("a.png", png + "x"), "is damaged: it goes on after the image's end");
  EXPECT_EQ(fault("a.png", png.substr(0, 8) + png.substr(8 + 25)), "is damaged: it has no header");
  EXPECT_EQ(picture_fault(path("good.png"), 23, 38), "has 23 x 37 pixels instead of 23 x 38");
  EXPECT_EQ(picture_fault(path("good.exr"), 22, 37), "has 23 x 37 pixels instead of 22 x 37");
  EXPECT_EQ(fault("a.exr", ""), "is empty");
  EXPECT_EQ(fault("a.exr", exr.substr(0, exr.size() - 1)), "is damaged, or no OpenEXR image");
  EXPECT_THAT(picture_fault(path("none.png"), 1, 1).value_or(""), HasSubstr("No such file"));
}

}  // namespace
}  // namespace billow::render
