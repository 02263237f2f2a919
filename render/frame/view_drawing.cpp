// The table.
#include "render/frame/view_drawing.h"

namespace billow::render {

namespace {

constexpr ViewDrawing table[] = {
    // view, legend, maker
    {View::textured, false, make_textured_painter},
    {View::velocity, true, make_velocity_painter},
};

}  // namespace

std::span<const ViewDrawing> view_drawings() { return table; }

const ViewDrawing& drawing_of(View view) { return row_for(table, &ViewDrawing::view, view); }

}  // namespace billow::render
