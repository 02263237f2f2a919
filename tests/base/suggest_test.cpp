// "Did you mean …?"
#include "base/suggest.h"

#include <gtest/gtest.h>

namespace billow {
namespace {

TEST(Suggestion, CountsEdits) {
  EXPECT_EQ(edit_distance("", "step"), 4);
  EXPECT_EQ(edit_distance("step", "step"), 0);
  EXPECT_EQ(edit_distance("stifness", "stiffness"), 1);
  EXPECT_EQ(edit_distance("setp", "step"), 1);
  EXPECT_EQ(edit_distance("FPS", "fps"), 0);
  EXPECT_EQ(edit_distance("lamda", "gamma"), 2);
}

TEST(Suggestion, NamesTheNearest) {
  const std::vector<std::string_view> keys{"step", "strip", "safety", "fps"};
  EXPECT_EQ(suggestion("setp", keys, "known"), "; did you mean 'step'?");
  EXPECT_EQ(suggestion("stripe", keys, "known"), "; did you mean 'strip'?");
  EXPECT_EQ(suggestion("fp", keys, "known"), "; did you mean 'fps'?");
}

TEST(Suggestion, ListsAllWhenNoneIsNear) {
  EXPECT_EQ(suggestion("colour", {"step", "fps"}, "its keys are"), "; its keys are: step, fps");
  EXPECT_EQ(suggestion("3", {"1", "2"}, "known are"), "; known are: 1, 2");
  EXPECT_EQ(suggestion(std::string(100000, 's'), {"step", "fps"}, "known are"), "; known are: step, fps");
}

}  // namespace
}  // namespace billow
