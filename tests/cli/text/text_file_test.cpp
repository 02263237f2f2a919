// How messages quote texts.
#include "cli/text/text_file.h"

#include <gtest/gtest.h>

namespace billow::cli {
namespace {

TEST(TextFile, ShowsWhatIsAroundAPlace) {
  EXPECT_EQ(shortened_around("x + 1", 2), "x + 1");
  const std::string digits = "0123456789012345678901234567890123456789012345678901234567890123456789";
  EXPECT_EQ(shortened_around(digits, 0), "01234567890123456789…");
  EXPECT_EQ(shortened_around(digits, 30), "…0123456789012345678901234567890123456789…");
  EXPECT_EQ(shortened_around(digits, 999), "…01234567890123456789");
}

TEST(TextFile, CutsBetweenCharacters) {
  std::string text;
  for (int k = 0; k < 50; ++k) text += "日";
  const std::string shown = shortened_around(text, 75);
  EXPECT_EQ(character_count(shown), 42u);
  EXPECT_FALSE(find_non_text(shown));
}

}  // namespace
}  // namespace billow::cli
