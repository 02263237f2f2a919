// Polygons through bytes: the same come back, and damage is noticed or harmless.
#include "sim/import/soup_codec.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

PolygonSoup sample() {
  PolygonSoup soup = test::soup_of(test::quad_grid(3, 3));
  soup.colour = Eigen::MatrixX3f::Constant(soup.position.rows(), 3, 0.25f);
  soup.group = {{"hem", {0, 3}}, {"", {1}}};
  soup.layout.vertex = {1, -1, 0, 4};
  soup.layout.loose = Eigen::MatrixX3d::Constant(1, 3, 0.5);
  soup.layout.face = {{0, 2, 3, -1}, {0, 1, 2, 3}};
  soup.layout.uv = Eigen::MatrixX2f::Constant(2, 2, 0.75);
  soup.layout.uv_corner = {{1, 0, 1, -1}, {-1, -1, -1, -1}};
  return soup;
}

TEST(SoupCodec, GivesBackWhatItWasGiven) {
  const PolygonSoup soup = sample(), copy = decode_soup(encode_soup(soup));
  EXPECT_EQ(copy.position, soup.position);
  EXPECT_EQ(copy.uv, soup.uv);
  EXPECT_EQ(copy.colour, soup.colour);
  EXPECT_EQ(copy.face, soup.face);
  EXPECT_EQ(copy.group, soup.group);
  EXPECT_EQ(copy.layout.vertex, soup.layout.vertex);
  EXPECT_EQ(copy.layout.loose, soup.layout.loose);
  EXPECT_EQ(copy.layout.face, soup.layout.face);
  EXPECT_EQ(copy.layout.uv, soup.layout.uv);
  EXPECT_EQ(copy.layout.uv_corner, soup.layout.uv_corner);
}

TEST(SoupCodec, NoticesEveryTruncation) {
  const std::string bytes = encode_soup(sample());
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(decode_soup(std::string_view(bytes).substr(0, length)), InputError) << length;
  EXPECT_THROW(decode_soup(bytes + "x"), InputError);
}

// A child that a hostile file took over may send anything: the parent must not read or write out of bounds.
TEST(SoupCodec, SurvivesDamage) {
  std::mt19937_64 random(1);
  const std::string whole = encode_soup(sample());
  for (int round = 0; round < 20000; ++round) {
    std::string bytes = whole;
    for (std::uint64_t k = random() % 4 + 1; k > 0; --k) bytes[random() % bytes.size()] = static_cast<char>(random());
    try {
      weld(decode_soup(bytes));
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace billow::sim
