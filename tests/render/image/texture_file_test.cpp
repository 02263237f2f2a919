// JPEG images beside PNG ones (png_test.cpp).
#include "render/image/texture_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace billow::render {
namespace {

using testing::HasSubstr;

std::string segment(unsigned char marker, const std::string& data) {
  const std::size_t size = data.size() + 2;
  return std::string("\xff") + static_cast<char>(marker) + static_cast<char>(size >> 8) +
         static_cast<char>(size & 255) + data;
}

// One grey block of a progressive image: every scan is valid, and brings one more bit of nothing to a coefficient.
std::string progressive(int scans) {
  const std::string one_code("\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 17);  // the bit 0: no difference, or nothing more
  std::string bytes = "\xff\xd8" + segment(0xdb, std::string(1, '\0') + std::string(64, '\x01')) +
                      segment(0xc2, std::string("\x08\0\x08\0\x08\x01\x01\x11\0", 9)) +
                      segment(0xc4, std::string(1, '\0') + one_code) + segment(0xc4, "\x10" + one_code);
  for (int scan = 0; scan < scans; ++scan) {
    const auto coefficient = static_cast<char>(scan / 14);
    const int step = scan % 14, low = 13 - step, high = step == 0 ? 0 : low + 1;
    bytes +=
        segment(0xda, std::string("\x01\x01\0", 3) + coefficient + coefficient + static_cast<char>(high << 4 | low));
    bytes += "\x7f";
  }
  return bytes + "\xff\xd9";
}

std::string fault(const std::string& bytes) {
  try {
    decode_texture(bytes, "it");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TextureFile, ReadsAProgressiveImageOfManyScans) {
  const Image image = decode_texture(progressive(100), "it");
  EXPECT_EQ(image.width, 8);
  EXPECT_EQ(image.pixels, std::vector<std::uint8_t>(8 * 8 * 3, 128));
}

// Each scan goes over the whole image: a small file could ask for hours.
TEST(TextureFile, RefusesMoreScansThanAnImageNeeds) {
  EXPECT_EQ(fault(progressive(101)), "it: the JPEG image is damaged: it has more than 100 scans");
}

TEST(TextureFile, RefusesMorePixelsThanItHolds) {
  std::string large = progressive(14);
  const std::size_t size = large.find(std::string("\x08\0\x08\0\x08", 5)) + 1;
  large.replace(size, 4, "\x20\x01\x20\x01");
  EXPECT_THAT(fault(large), HasSubstr("8193 x 8193 pixels; at most 8192 x 8192"));
}

}  // namespace
}  // namespace billow::render
