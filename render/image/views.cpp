// The table.
#include "render/image/views.h"

namespace billow::render {

namespace {

constexpr ViewRow table[] = {
    // view, name, folder, extension
    {View::textured, "textured", "textured", ".png"},
    {View::velocity, "velocity", "velocity", ".png"},
    {View::data, "data", "data", ".exr"},
    {View::depth, "depth", "depth", ".png"},
    {View::normal, "normal", "normal", ".png"},
    {View::id, "id", "id", ".png"},
};

}  // namespace

std::span<const ViewRow> views() { return table; }

const ViewRow& row_of(View view) { return row_for(table, &ViewRow::view, view); }

std::vector<std::string_view> png_views() {
  std::vector<std::string_view> names;
  for (const ViewRow& row : table)
    if (is_png(row.view)) names.push_back(row.name);
  return names;
}

Words<View> words(View) {
  static constexpr auto list = words_of(table, &ViewRow::name, &ViewRow::view);
  return list;
}

}  // namespace billow::render
