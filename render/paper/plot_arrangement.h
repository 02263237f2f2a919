// How the curves of a plot are told apart: which of the things they differ in is a colour, which a mark, which a panel.
#pragma once

#include <utility>
#include <vector>

#include "render/paper/plot.h"

namespace billow::render {

/// What can still be told apart: colours, marks with dashes, and curves in a panel.
inline constexpr int most_colours = 8, most_marks = 6, most_in_a_panel = 12;

struct Look {
  int panel = 0, colour = 0, mark = 0;
};

/// Dimensions are told by their indices, -1 being none; those with a single value have no part in it.
struct Arrangement {
  int colour = -1;                 // dimension that has the colours; also the marks, where no other has
  int mark = -1;                   // dimension that has the marks and dashes
  int colours_a_panel = 1;         // where they are too many for one panel, the colour's values go on in the next
  std::vector<int> by_panel = {};  // dimensions that have panels, the slowest first
  int parts = 1;                   // panels that the colour's values take, the fastest
  int panels = 1;

  bool is_split() const { return parts > 1; }
};

/// The dimensions in their order, as far as that makes few panels: the first has the colours, the next the marks, or
/// panels as the rest have. Otherwise that choice which makes the fewest panels. Never more of anything than the limits
/// above.
Arrangement arranged(const std::vector<Dimension>& dimensions);

Look look_of(const Arrangement& arrangement, const std::vector<Dimension>& dimensions, const std::vector<int>& at);

/// The indices of the values that all curves of a panel share, in the order of `by_panel`.
std::vector<int> shared_values(const Arrangement& arrangement, const std::vector<Dimension>& dimensions, int panel);

/// The first and one past the last of the colour's values in a panel.
std::pair<int, int> colours_of_panel(const Arrangement& arrangement, const std::vector<Dimension>& dimensions,
                                     int panel);

}  // namespace billow::render
