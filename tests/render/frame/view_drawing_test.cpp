// Every view can be drawn.
#include "render/frame/view_drawing.h"

#include <gtest/gtest.h>

namespace billow::render {
namespace {

TEST(ViewDrawings, HaveARowForEveryView) {
  EXPECT_EQ(view_drawings().size(), views().size());
  for (const ViewRow& row : views()) EXPECT_EQ(drawing_of(row.view).view, row.view) << row.name;
  EXPECT_THROW(drawing_of(static_cast<View>(-1)), std::logic_error);
}

TEST(ViewDrawings, LayTheLegendOverVelocitiesAlone) {
  EXPECT_FALSE(drawing_of(View::textured).legend);
  EXPECT_TRUE(drawing_of(View::velocity).legend);
}

}  // namespace
}  // namespace billow::render
