// Numbers as people read them.
#include "base/readable_number.h"

#include <gtest/gtest.h>

namespace billow {
namespace {

TEST(ReadableNumber, IsPlainWhereThatIsShort) {
  EXPECT_EQ(readable_number(0.0), "0");
  EXPECT_EQ(readable_number(-0.0), "0");
  EXPECT_EQ(readable_number(2.312), "2.31");
  EXPECT_EQ(readable_number(-2.316), "\u22122.32");
  EXPECT_EQ(readable_number(0.001), "0.001");
  EXPECT_EQ(readable_number(14502.4), "14502");
  EXPECT_EQ(readable_number(0.0025563, 4), "0.002556");
}

TEST(ReadableNumber, HasPowersOfTenWhereItIsNot) {
  EXPECT_EQ(readable_number(1e6), "10⁶");
  EXPECT_EQ(readable_number(999999.0), "10⁶");  // rounded first
  EXPECT_EQ(readable_number(3.59e5, 4), "3.59·10⁵");
  EXPECT_EQ(readable_number(-1.24e-12), "\u22121.24·10⁻¹²");
}

TEST(Grouped, PutsACommaBeforeEveryThreeDigits) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(14502), "14,502");
  EXPECT_EQ(grouped(-1234567), "\u22121,234,567");
}

}  // namespace
}  // namespace billow
