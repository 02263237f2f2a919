// The table of views: a row for each picture that can be drawn of a frame. How each is drawn is frame/view_drawing.h's.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/words.h"

namespace billow::render {

enum class View { textured, velocity, data, depth, normal, id };

struct ViewRow {
  View view;
  std::string_view name;       // as scenes and records write it
  std::string_view folder;     // of its frames, in a run's folder
  std::string_view extension;  // of its frames' files: .png, which browsers and `billow compare` read, or .exr
};

/// All of them, in the order in which they are listed.
std::span<const ViewRow> views();
/// Throws std::logic_error when the view has no row.
const ViewRow& row_of(View view);
Words<View> words(View);

/// The names of those whose frames are PNG files.
std::vector<std::string_view> png_views();

inline bool is_png(View view) { return row_of(view).extension == ".png"; }
inline std::string_view name(View view) { return row_of(view).name; }
inline std::string_view folder(View view) { return row_of(view).folder; }

}  // namespace billow::render
