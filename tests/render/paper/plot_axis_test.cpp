// Ticks of axes.
#include "render/paper/plot_axis.h"

#include <gmock/gmock.h>

namespace billow::render {
namespace {

std::vector<std::string> labels_of(const PlotAxis& axis) {
  std::vector<std::string> labels;
  for (const Tick& tick : axis.ticks)
    if (!tick.label.empty()) labels.push_back(tick.label);
  return labels;
}

using testing::ElementsAre;

TEST(PlotAxis, HasRoundNumbersAroundItsData) {
  EXPECT_THAT(labels_of(linear_axis(0.82, 1.39, 4)), ElementsAre("0.8", "1.0", "1.2", "1.4"));
  EXPECT_THAT(labels_of(linear_axis(9000, 14502, 4)), ElementsAre("8,000", "10,000", "12,000", "14,000", "16,000"));
  EXPECT_THAT(labels_of(linear_axis(-0.5, 0.5, 2)), ElementsAre("−0.5", "0.0", "0.5"));
  EXPECT_THAT(labels_of(linear_axis(0, 4e-5, 2)), ElementsAre("0", "2 × 10⁻⁵", "4 × 10⁻⁵"));
}

TEST(PlotAxis, HasRoomAroundAConstant) {
  const PlotAxis axis = linear_axis(400, 400, 4);
  EXPECT_LT(axis.low, 400);
  EXPECT_GT(axis.high, 400);
  EXPECT_GE(labels_of(axis).size(), 2u);
  EXPECT_THAT(labels_of(linear_axis(391495, 391495, 4)),
              ElementsAre("340,000", "360,000", "380,000", "400,000", "420,000", "440,000"));
  const PlotAxis zero = linear_axis(0, 0, 4);
  EXPECT_LT(zero.low, zero.high);
  EXPECT_THAT(labels_of(logarithmic_axis(1e6, 1e6, 6)), ElementsAre("10⁵", "10⁶", "10⁷"));
}

TEST(PlotAxis, LabelsPowersOfTen) {
  EXPECT_THAT(labels_of(logarithmic_axis(0.02, 900, 6)), ElementsAre("0.01", "0.1", "1", "10", "100", "1,000"));
  EXPECT_THAT(labels_of(logarithmic_axis(1e3, 1e9, 8)), ElementsAre("10³", "10⁴", "10⁵", "10⁶", "10⁷", "10⁸", "10⁹"));
  EXPECT_THAT(labels_of(logarithmic_axis(1e-12, 1, 5)), ElementsAre("10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"));
}

// A decade and a half has one power of ten or two: too few to read a value by.
TEST(PlotAxis, LabelsTwosAndFivesWherePowersOfTenAreFew) {
  EXPECT_THAT(labels_of(logarithmic_axis(0.013, 0.33, 10)), ElementsAre("0.01", "0.02", "0.05", "0.1", "0.2", "0.5"));
  EXPECT_THAT(labels_of(logarithmic_axis(1.1, 1.4, 4)), ElementsAre("1.1", "1.2", "1.3", "1.4"));
}

TEST(PlotAxis, FitsItsDataOrGivesItRoom) {
  const PlotAxis fit = fitted(linear_axis(0.1, 9.9, 5), 0.1, 9.9, false, 0.02);
  EXPECT_NEAR(fit.low, 0.1 - 0.02 * 9.8, 1e-12);
  EXPECT_THAT(labels_of(fit), ElementsAre("0", "2", "4", "6", "8", "10"));
  const PlotAxis wide = with_room(linear_axis(0, 10, 5), 0, 10, false, 0.02);
  EXPECT_NEAR(wide.low, -0.2, 1e-12);
  EXPECT_NEAR(wide.high, 10.2, 1e-12);
}

}  // namespace
}  // namespace billow::render
