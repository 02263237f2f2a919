// Cryptomatte's hashes against published values.
#include "render/image/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace billow::render {
namespace {

// Seed 0, of Appleby's reference implementation.
TEST(Cryptomatte, HashesAsMurmur3Does) {
  EXPECT_EQ(murmur3(""), 0x00000000u);
  EXPECT_EQ(murmur3("test"), 0xba6bd213u);
  EXPECT_EQ(murmur3("hello"), 0x248bfa47u);
  EXPECT_EQ(murmur3("Hello, world!"), 0xc0363e43u);
  EXPECT_EQ(murmur3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

// A NaN or an infinity would not survive a reader, a denormal not a flush to zero.
TEST(Cryptomatte, IdsAreNormalNumbersAndElseTheHashesBits) {
  int flipped = 0;
  for (int k = 0; k < 2000; ++k) {
    const std::string name = "body" + std::to_string(k);
    const float id = cryptomatte_id(name);
    EXPECT_TRUE(std::isnormal(id)) << name;
    flipped += std::bit_cast<std::uint32_t>(id) != murmur3(name);
  }
  EXPECT_GT(flipped, 0);
  EXPECT_LT(flipped, 60);  // 2 exponents of 256
}

TEST(Cryptomatte, ListsNamesInItsManifest) {
  const ImageNotes notes = cryptomatte_notes("id", {"hello", "a \"b\"\\"});
  ASSERT_EQ(notes.size(), 4u);
  const std::string prefix = notes[0].first.substr(0, notes[0].first.rfind('/') + 1);
  EXPECT_EQ(prefix.size(), std::string("cryptomatte/1234567/").size());
  EXPECT_EQ(notes[0].second, "id");
  EXPECT_EQ(notes[3].first, prefix + "manifest");
  EXPECT_NE(notes[3].second.find("{\"hello\":\"248bfa47\",\"a \\\"b\\\"\\\\\":\""), std::string::npos)
      << notes[3].second;
}

}  // namespace
}  // namespace billow::render
