// The table.
#include "render/frame/view_drawing.h"

namespace billow::render {

namespace {

// clang-format off
constexpr ViewDrawing table[] = {
    // view, legend, maker
    {View::textured, false, make_textured_painter},
    {View::velocity, true, make_velocity_painter},
    {View::data, false, make_data_painter},
    {View::depth, false, make_depth_painter},
    {View::normal, false, make_normal_painter},
    {View::id, false, make_id_painter},
};
// clang-format on

}  // namespace

std::span<const ViewDrawing> view_drawings() { return table; }

const ViewDrawing& drawing_of(View view) { return row_for(table, &ViewDrawing::view, view); }

}  // namespace billow::render
