// The table.
#include "render/image/views.h"

namespace billow::render {

namespace {

constexpr ViewRow table[] = {
    // view, name, folder
    {View::textured, "textured", "textured"},
    {View::velocity, "velocity", "velocity"},
};

}  // namespace

std::span<const ViewRow> views() { return table; }

const ViewRow& row_of(View view) { return row_for(table, &ViewRow::view, view); }

Words<View> words(View) {
  static constexpr auto list = words_of(table, &ViewRow::name, &ViewRow::view);
  return list;
}

}  // namespace billow::render
