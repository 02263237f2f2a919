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
  for (const ViewDrawing& drawing : view_drawings()) EXPECT_EQ(drawing.legend, drawing.view == View::velocity);
}

}  // namespace
}  // namespace billow::render
