// Few dimensions, so all choices are tried.
#include "render/paper/plot_arrangement.h"

#include <algorithm>
#include <utility>

namespace billow::render {

namespace {

constexpr int few_panels = 9;

int size_of(const std::vector<Dimension>& dimensions, int d) { return static_cast<int>(dimensions[d].values.size()); }

// Dimensions that curves differ in, but for the two that have colours and marks.
std::vector<int> remaining(const std::vector<Dimension>& dimensions, int colour, int mark) {
  std::vector<int> rest;
  for (int d = 0; d < static_cast<int>(dimensions.size()); ++d)
    if (d != colour && d != mark && size_of(dimensions, d) > 1) rest.push_back(d);
  std::stable_partition(rest.begin(), rest.end(), [&](int d) { return dimensions[d].own_scale; });
  return rest;
}

Arrangement with(const std::vector<Dimension>& dimensions, int colour, int mark) {
  Arrangement arrangement{colour, mark, 1, remaining(dimensions, colour, mark), 1, 1};
  if (colour >= 0) {
    const int colours = size_of(dimensions, colour), marks = mark < 0 ? 1 : size_of(dimensions, mark);
    const int most = std::min(most_colours, std::max(1, most_in_a_panel / marks));
    arrangement.parts = (colours + most - 1) / most;
    arrangement.colours_a_panel = (colours + arrangement.parts - 1) / arrangement.parts;
    arrangement.parts = (colours + arrangement.colours_a_panel - 1) / arrangement.colours_a_panel;
  }
  arrangement.panels = arrangement.parts;
  for (const int d : arrangement.by_panel) arrangement.panels *= size_of(dimensions, d);
  return arrangement;
}

// Dimensions that may have colours or marks.
std::vector<int> candidates(const std::vector<Dimension>& dimensions) {
  std::vector<int> list;
  for (int d = 0; d < static_cast<int>(dimensions.size()); ++d)
    if (size_of(dimensions, d) > 1 && !dimensions[d].own_scale) list.push_back(d);
  return list;
}

bool fits_marks(const std::vector<Dimension>& dimensions, int d) { return size_of(dimensions, d) <= most_marks; }

}  // namespace

Arrangement arranged(const std::vector<Dimension>& dimensions) {
  const std::vector<int> list = candidates(dimensions);
  if (list.empty()) return with(dimensions, -1, -1);
  const int second = list.size() > 1 && fits_marks(dimensions, list[1]) ? list[1] : -1;
  Arrangement best = with(dimensions, list[0], second);
  for (const Arrangement& natural : {best, with(dimensions, list[0], -1)})
    if (!natural.is_split() && natural.panels <= few_panels) return natural;
  for (const int colour : list) {
    if (const Arrangement one = with(dimensions, colour, -1); one.panels < best.panels) best = one;
    for (const int mark : list)
      if (mark != colour && fits_marks(dimensions, mark))
        if (const Arrangement two = with(dimensions, colour, mark); two.panels < best.panels) best = two;
  }
  return best;
}

Look look_of(const Arrangement& arrangement, const std::vector<Dimension>& dimensions, const std::vector<int>& at) {
  Look look;
  for (const int d : arrangement.by_panel) look.panel = look.panel * size_of(dimensions, d) + at[d];
  look.panel *= arrangement.parts;
  if (arrangement.colour >= 0) {
    look.panel += at[arrangement.colour] / arrangement.colours_a_panel;
    look.colour = at[arrangement.colour] % arrangement.colours_a_panel;
  }
  look.mark = arrangement.mark >= 0 ? at[arrangement.mark] : look.colour;
  return look;
}

std::vector<int> shared_values(const Arrangement& arrangement, const std::vector<Dimension>& dimensions, int panel) {
  std::vector<int> values(arrangement.by_panel.size());
  int rest = panel / arrangement.parts;
  for (std::size_t k = values.size(); k-- > 0;) {
    const int size = size_of(dimensions, arrangement.by_panel[k]);
    values[k] = rest % size;
    rest /= size;
  }
  return values;
}

std::pair<int, int> colours_of_panel(const Arrangement& arrangement, const std::vector<Dimension>& dimensions,
                                     int panel) {
  const int first = panel % arrangement.parts * arrangement.colours_a_panel;
  return {first, std::min(first + arrangement.colours_a_panel, size_of(dimensions, arrangement.colour))};
}

}  // namespace billow::render
