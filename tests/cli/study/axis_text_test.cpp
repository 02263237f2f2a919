// Names of axes and values.
#include "cli/study/axis_text.h"

#include <gtest/gtest.h>

namespace billow::cli {
namespace {

TEST(AxisText, HasTheUnitOfTheScenesKey) {
  EXPECT_EQ(default_axis_label("h", "solver.step"), "h [s]");
  EXPECT_EQ(default_axis_label("mass", "bodies.drape.cloth.mass"), "mass [kg]");
  EXPECT_EQ(default_axis_label("mass", "bodies.0.cloth.mass"), "mass [kg]");
  EXPECT_EQ(default_axis_label("method", "solver.method"), "method");
  EXPECT_EQ(default_axis_label("h", "solver.stop"), "h");
  EXPECT_EQ(default_axis_label("solver", ""), "solver");
}

TEST(AxisText, CallsLambdaByItsLetter) {
  EXPECT_EQ(default_axis_label("lambda", "solver.filter.lambda"), "λ [per mean rest length]");
  EXPECT_EQ(default_axis_label("width", "solver.filter.lambda"), "λ [per mean rest length]");
  EXPECT_EQ(default_axis_label("lambda", ""), "λ");
}

TEST(AxisText, SaysWhatNumbersAreOf) {
  EXPECT_EQ(shown_value("h [s]", "0.01"), "h = 0.01 s");
  EXPECT_EQ(shown_value("λ [per mean rest length]", "1"), "λ = 1");
  EXPECT_EQ(shown_value("ratio", "1e3"), "ratio = 1e3");
  EXPECT_EQ(shown_value("filter", "none"), "filter = none");
  EXPECT_EQ(shown_value("method", "rk4"), "rk4");
  EXPECT_EQ(shown_value("mesh", "400 particles"), "400 particles");
}

}  // namespace
}  // namespace billow::cli
