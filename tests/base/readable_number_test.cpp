// Numbers for people.
#include "base/readable_number.h"

#include <gtest/gtest.h>

#include <cmath>

namespace billow {
namespace {

TEST(Readable, GroupsThousandsAndKeepsWholeNumbersWhole) {
  EXPECT_EQ(readable(14502), "14,502");
  EXPECT_EQ(readable(1e6), "1,000,000");
  EXPECT_EQ(readable(-1234567), "−1,234,567");
  EXPECT_EQ(readable(999), "999");
  EXPECT_EQ(readable(14502.37), "14,502");
}

TEST(Readable, RoundsToSignificantDigits) {
  EXPECT_EQ(readable(0.0013912345), "0.001391");
  EXPECT_EQ(readable(1.5), "1.5");
  EXPECT_EQ(readable(9.99996), "10");
  EXPECT_EQ(readable(99.994), "99.99");
  EXPECT_EQ(readable(3.14159, 3), "3.14");
  EXPECT_EQ(readable(3.9, 1), "4");
  EXPECT_EQ(readable(0.0), "0");
  EXPECT_EQ(readable(-0.0), "0");
}

TEST(Readable, WritesPowersOfTenWhereZerosWouldHaveToBeCounted) {
  EXPECT_EQ(readable(1.451e-5), "1.451 × 10⁻⁵");
  EXPECT_EQ(readable(1e9), "10⁹");
  EXPECT_EQ(readable(-2.5e12), "−2.5 × 10¹²");
  EXPECT_EQ(readable(1e-4), "0.0001");
  EXPECT_EQ(readable(5e-324), "4.941 × 10⁻³²⁴");
}

TEST(Readable, SaysWhatIsNoNumber) {
  EXPECT_EQ(readable(INFINITY), "inf");
  EXPECT_EQ(readable(NAN), "nan");
}

TEST(Grouped, PutsACommaBeforeEveryThreeDigits) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(-1234567), "−1,234,567");
}

TEST(Counted, HasTheWordForOneForOneAlone) {
  EXPECT_EQ(counted(0, "image"), "0 images");
  EXPECT_EQ(counted(1, "image"), "1 image");
  EXPECT_EQ(counted(14502, "spring"), "14,502 springs");
  EXPECT_EQ(counted(1, "run is", "runs are"), "1 run is");
  EXPECT_EQ(counted(2, "run is", "runs are"), "2 runs are");
}

TEST(ReadableFixed, HasAllItsDecimalsAndNoNegativeZero) {
  EXPECT_EQ(readable_fixed(1024.5, 2), "1,024.50");
  EXPECT_EQ(readable_fixed(-0.001, 2), "0.00");
  EXPECT_EQ(readable_fixed(-12000, 0), "−12,000");
}

}  // namespace
}  // namespace billow
