// From the top down: title, legend, panels, the name of the x axis, note.
#include "render/paper/plot_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "base/error.h"
#include "render/paper/canvas.h"

namespace billow::render {

namespace {

constexpr double page_width = 1280.0, usual_height = 800.0, least_panel_height = 420.0, page_edge = 28.0;
constexpr double title_font = 21.0, text_font = 18.0, small_font = 16.0, note_font = 15.0;
constexpr double line_factor = 1.36;  // from one line to the next, of the font's size
constexpr double column_gap = 30.0, row_gap = 22.0, tick_gap = 14.0;
constexpr double sample_gap = 10.0, entry_gap = 30.0;
constexpr std::size_t most_lines = 3;      // of a title or a legend's entry
constexpr double most_upright = 220.0;     // that turned labels along x may take
constexpr double largest_height = 8192.0;  // that billow reads back
constexpr double room = 0.02;              // beyond the data, of an axis

double height_of_line(double size) { return std::round(line_factor * size); }

/// Least and greatest of some numbers.
struct Extent {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  void add(double value) { least = std::min(least, value), greatest = std::max(greatest, value); }
  bool empty() const { return greatest < least; }
};

PlotAxis axis_of(const Extent& extent, bool logarithmic, double wanted) {
  return logarithmic ? logarithmic_axis(extent.least, extent.greatest, wanted)
                     : linear_axis(extent.least, extent.greatest, wanted);
}

double widest_label(Canvas& canvas, const PlotAxis& axis, double size) {
  canvas.set_font(size);
  double widest = 0.0;
  for (const Tick& tick : axis.ticks) widest = std::max(widest, canvas.text_width(tick.label));
  return widest;
}

// The dimensions of a plot; of one that names none, its curves' names.
std::vector<Dimension> dimensions_of(const Plot& plot) {
  if (!plot.dimensions.empty() || plot.curves.size() < 2) return plot.dimensions;
  Dimension names;
  for (const Curve& curve : plot.curves) names.values.push_back(curve.name);
  return {names};
}

class Layout {
 public:
  explicit Layout(const Plot& plot)
      : plot_(plot), dimensions_(dimensions_of(plot)), arrangement_(arranged(dimensions_)), canvas_(1, 1) {
    choose_looks();
  }

  PlotLayout made() {
    if (shown_panels_.empty()) return page_;
    page_.width = static_cast<int>(page_width);
    columns_ = columns_of_panels();
    page_.tick_size = columns_ == 1 ? text_font : columns_ == 2 ? small_font : note_font;
    y_ = page_edge;
    add_lines(plot_.title, title_font, true, false, most_lines);
    if (!plot_.title.empty()) y_ += 6.0;
    add_shared_legend();
    add_panels();
    add_lines(plot_.note, note_font, false, true, 1000);
    page_.height = static_cast<int>(std::ceil(y_ + page_edge - 8.0));
    return page_;
  }

 private:
  void choose_looks() {
    std::set<int> panels;
    for (std::size_t c = 0; c < plot_.curves.size(); ++c) {
      const Curve& curve = plot_.curves[c];
      std::vector<int> at = curve.at;
      if (at.empty()) at.assign(dimensions_.size(), static_cast<int>(c));
      page_.looks.push_back(look_of(arrangement_, dimensions_, at));
      if (!has_points(plot_, curve)) continue;
      panels.insert(page_.looks.back().panel);
      for (std::size_t d = 0; d < at.size(); ++d) shown_values_.emplace(static_cast<int>(d), at[d]);
    }
    shown_panels_.assign(panels.begin(), panels.end());
  }

  // Three, but where panels of one kind come in twos or fours: a row shows one kind only.
  int columns_of_panels() const {
    constexpr std::size_t most_in_two_columns = 12;
    const std::size_t count = shown_panels_.size();
    if (count == 1) return 1;
    if (count == 2 || count == 4) return 2;
    if (arrangement_.by_panel.size() < 2 || count > most_in_two_columns) return 3;
    const auto a_kind = count / dimensions_[arrangement_.by_panel.front()].values.size();
    return a_kind % 3 != 0 && a_kind % 2 == 0 ? 2 : 3;
  }

  // Lines across the page from y_ on.
  void add_lines(const std::string& text, double size, bool bold, bool quiet, std::size_t most) {
    canvas_.set_font(size, bold);
    for (const std::string& line : canvas_.lines_of(text, page_width - 2.0 * page_edge, most)) {
      page_.texts.push_back({line, page_edge, y_ + 0.5 * height_of_line(size), size, 0.0, bold, quiet, false});
      y_ += height_of_line(size);
    }
  }

  // Entries one after another between `left` and `right` from `y` on, broken into lines; returns where they end.
  struct Entry {
    std::string text;
    int colour, mark;
  };
  double add_entries(const std::vector<Entry>& entries, double left, double right, double y, double size) {
    canvas_.set_font(size);
    const double height = height_of_line(size) + 2.0;
    double x = left, lowest = y + height;
    for (const Entry& entry : entries) {
      const double begin = sample_length + sample_gap;
      const std::vector<std::string> lines = canvas_.lines_of(entry.text, right - left - begin, most_lines);
      double width = 0.0;
      for (const std::string& line : lines) width = std::max(width, canvas_.text_width(line));
      if (x > left && x + begin + width > right) {
        x = left;
        y = lowest;
        lowest = y + height;
      }
      page_.samples.push_back({x, y + 0.5 * height, entry.colour, entry.mark});
      for (std::size_t l = 0; l < lines.size(); ++l)
        page_.texts.push_back({lines[l], x + begin, y + (static_cast<double>(l) + 0.5) * height, size});
      lowest = std::max(lowest, y + static_cast<double>(lines.size()) * height);
      x += begin + width + entry_gap;
    }
    return entries.empty() ? y : lowest;
  }

  // Of the colour's values `first` to `last`. Where no other dimension has the marks, each colour has its own.
  std::vector<Entry> colour_entries(int first, int last) const {
    std::vector<Entry> entries;
    if (arrangement_.colour < 0) return entries;
    for (int v = first; v < last; ++v) {
      if (!shown_values_.contains({arrangement_.colour, v})) continue;
      const int look = v % arrangement_.colours_a_panel;
      entries.push_back({dimensions_[arrangement_.colour].values[v], look, arrangement_.mark < 0 ? look : -1});
    }
    return entries;
  }

  std::vector<Entry> mark_entries() const {
    std::vector<Entry> entries;
    if (arrangement_.mark < 0) return entries;
    const std::vector<std::string>& values = dimensions_[arrangement_.mark].values;
    for (int v = 0; v < static_cast<int>(values.size()); ++v)
      if (shown_values_.contains({arrangement_.mark, v})) entries.push_back({values[v], -1, v});
    return entries;
  }

  // A single curve that has a name of its own among dimensions of one value, or of none, is named too.
  std::vector<Entry> only_entry() const {
    if (arrangement_.colour >= 0 || arrangement_.panels > 1 || plot_.dimensions.empty()) return {};
    return {{plot_.curves.front().name, 0, 0}};
  }

  void add_shared_legend() {
    const double left = page_edge, right = page_width - page_edge;
    y_ = add_entries(only_entry(), left, right, y_, text_font);
    if (arrangement_.colour >= 0 && !arrangement_.is_split())
      y_ = add_entries(colour_entries(0, arrangement_.colours_a_panel), left, right, y_, text_font);
    y_ = add_entries(mark_entries(), left, right, y_, text_font);
    y_ += 14.0;
  }

  // "plain, λ = 1": what all curves of a panel share.
  std::string heading_of(int panel) const {
    const std::vector<int> values = shared_values(arrangement_, dimensions_, panel);
    std::string heading;
    for (std::size_t k = 0; k < values.size(); ++k)
      heading += (k ? ", " : "") + dimensions_[arrangement_.by_panel[k]].values[values[k]];
    return heading;
  }

  // Panels of one value of what has scales of its own share their y axis.
  bool own_scales() const {
    return !arrangement_.by_panel.empty() && dimensions_[arrangement_.by_panel.front()].own_scale;
  }
  int scale_of(int panel) const { return own_scales() ? shared_values(arrangement_, dimensions_, panel).front() : 0; }

  Extent x_extent() const {
    Extent extent;
    for (std::size_t c = 0; c < plot_.curves.size(); ++c)
      for (std::size_t k = 0; k < plot_.curves[c].x.size(); ++k)
        if (is_shown(plot_, plot_.curves[c].x[k], plot_.curves[c].y[k])) extent.add(plot_.curves[c].x[k]);
    return extent;
  }

  Extent y_extent(int scale) const {
    Extent extent;
    for (std::size_t c = 0; c < plot_.curves.size(); ++c)
      if (scale_of(page_.looks[c].panel) == scale)
        for (std::size_t k = 0; k < plot_.curves[c].x.size(); ++k)
          if (is_shown(plot_, plot_.curves[c].x[k], plot_.curves[c].y[k])) extent.add(plot_.curves[c].y[k]);
    return extent;
  }

  // As many labels as stand beside each other without touching.
  PlotAxis x_axis(double width) {
    if (!plot_.x_names.empty()) return named_axis(width);
    const Extent extent = x_extent();
    for (double wanted = std::clamp(std::floor(width / 60.0), 2.0, 12.0);; --wanted) {
      const PlotAxis axis =
          fitted(axis_of(extent, plot_.log_x, wanted), extent.least, extent.greatest, plot_.log_x, room);
      if (wanted <= 2.0 || labels_fit(axis, width)) return axis;
    }
  }

  bool labels_fit(const PlotAxis& axis, double width) {
    canvas_.set_font(page_.tick_size);
    const auto place = [&](double at) {
      return plot_.log_x ? width * std::log(at / axis.low) / std::log(axis.high / axis.low)
                         : width * (at - axis.low) / (axis.high - axis.low);
    };
    double end = -std::numeric_limits<double>::infinity();
    for (const Tick& tick : axis.ticks) {
      if (tick.label.empty()) continue;
      const double half = 0.5 * canvas_.text_width(tick.label);
      if (place(tick.at) - half < end) return false;
      end = place(tick.at) + half + 12.0;
    }
    return true;
  }

  // One tick a name, in lines as wide as there is room; turned where a word would not fit.
  PlotAxis named_axis(double width) {
    const auto names = static_cast<double>(plot_.x_names.size());
    canvas_.set_font(page_.tick_size);
    const double wide = width / names - 14.0;
    page_.upright_x = std::any_of(plot_.x_names.begin(), plot_.x_names.end(),
                                  [&](const std::string& name) { return widest_part(name, ' ') > wide; });
    const auto upright_lines = static_cast<std::size_t>(
        std::clamp(std::floor((wide + 14.0) / height_of_line(page_.tick_size)), 1.0, double{most_lines}));
    PlotAxis axis{-0.5, names - 0.5};
    for (std::size_t k = 0; k < plot_.x_names.size(); ++k) {
      const std::vector<std::string> lines = canvas_.lines_of(plot_.x_names[k], page_.upright_x ? most_upright : wide,
                                                              page_.upright_x ? upright_lines : most_lines);
      axis.ticks.push_back({static_cast<double>(k), fmt::format("{}", fmt::join(lines, "\n"))});
      x_lines_ = std::max(x_lines_, lines.size());
    }
    return axis;
  }

  // The widest part of a text between separators.
  double widest_part(const std::string& text, char separator) {
    double widest = 0.0;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find(separator, begin), text.size());
      widest = std::max(widest, canvas_.text_width(text.substr(begin, end - begin)));
      begin = end + 1;
    }
    return widest;
  }

  double widest_line(const PlotAxis& axis) {
    canvas_.set_font(page_.tick_size);
    double widest = 0.0;
    for (const Tick& tick : axis.ticks) widest = std::max(widest, widest_part(tick.label, '\n'));
    return widest;
  }

  double x_labels_height(const PlotAxis& axis) {
    return page_.upright_x ? widest_line(axis) + 14.0
                           : static_cast<double>(x_lines_) * height_of_line(page_.tick_size) + 6.0;
  }

  double panel_height() const { return columns_ == 1 ? 0.0 : columns_ == 2 ? 400.0 : 300.0; }

  PlotAxis y_axis(const Extent& extent, double wanted) const {
    return with_room(axis_of(extent, plot_.log_y, wanted), extent.least, extent.greatest, plot_.log_y, room);
  }

  // y axes by scale, for panels of that height.
  std::map<int, PlotAxis> y_axes(double height) {
    std::map<int, PlotAxis> axes;
    for (const int panel : shown_panels_)
      if (const int scale = scale_of(panel); !axes.contains(scale))
        axes[scale] = y_axis(y_extent(scale), std::clamp(std::floor(height / 60.0), 3.0, 10.0));
    return axes;
  }

  /// Columns of panels; `inner` is what each needs left of its axes.
  struct Grid {
    double left, inner, gap, right = page_width - page_edge - 8.0;
    int columns = 1;

    double pitch() const { return (right - left + gap) / columns; }
    double width() const { return pitch() - gap - inner; }
    double left_of(std::size_t column) const { return left + static_cast<double>(column) * pitch() + inner; }
  };

  int rows() const { return (static_cast<int>(shown_panels_.size()) + columns_ - 1) / columns_; }

  // From the uppermost panel's top to the lowest one's bottom, near enough to break the name of y into lines.
  double height_of_panels() const {
    return columns_ == 1 ? std::max(least_panel_height, usual_height - y_ - 90.0) : rows() * panel_height();
  }

  void add_panels() {
    const std::map<int, PlotAxis> y_axis = y_axes(columns_ == 1 ? height_of_panels() : panel_height());
    double y_labels = 0.0;
    for (const auto& [scale, axis] : y_axis)
      y_labels = std::max(y_labels, widest_label(canvas_, axis, page_.tick_size) + tick_gap);
    canvas_.set_font(text_font);
    const std::vector<std::string> y_lines =
        canvas_.lines_of(own_scales() ? "" : plot_.y_label, height_of_panels(), most_lines);
    const double names = y_lines.empty() ? 0.0 : static_cast<double>(y_lines.size()) * height_of_line(text_font) + 8.0;
    Grid grid{page_edge + names + (own_scales() ? 0.0 : y_labels), own_scales() ? y_labels : 0.0, column_gap};
    grid.columns = columns_;
    // The labels of x stick out of their panels by up to half of their width.
    const double sticks_out =
        plot_.x_names.empty() ? 0.5 * widest_label(canvas_, x_axis(grid.width()), page_.tick_size) : 0.0;
    grid.right = page_width - std::max(page_edge + 8.0, sticks_out + 10.0);
    grid.gap = std::max(column_gap, 2.0 * sticks_out);
    const PlotAxis x = x_axis(grid.width());
    add_rows(grid, x, y_axis);
    add_axis_names(y_lines, {grid.left + grid.inner, grid.right},
                   {page_.panels.front().top, page_.panels.back().bottom});
  }

  // Panels in rows from y_ on; the lowest of each column have the labels of x.
  void add_rows(const Grid& grid, const PlotAxis& x, const std::map<int, PlotAxis>& y_axis) {
    const std::size_t count = shown_panels_.size(), columns = static_cast<std::size_t>(columns_);
    const double names_below = x_labels_height(x);
    for (std::size_t first = 0; first < count; first += columns) {
      const std::size_t last = std::min(count, first + columns);
      double top = y_;
      for (std::size_t p = first; p < last; ++p)
        top = std::max(top, add_heading(shown_panels_[p], grid.left_of(p - first), grid.width()));
      const double bottom = top + (columns == 1 && count == 1 ? single_height(top, names_below) : panel_height());
      bool named = false;
      for (std::size_t p = first; p < last; ++p) {
        const bool lowest = p + columns >= count;
        named = named || lowest;
        add_panel(shown_panels_[p], {grid.left_of(p - first),
                                     top,
                                     grid.left_of(p - first) + grid.width(),
                                     bottom,
                                     x,
                                     y_axis.at(scale_of(shown_panels_[p])),
                                     lowest,
                                     own_scales() || p == first,
                                     {}});
      }
      y_ = bottom + (named ? names_below : 0.0) + (last < count ? row_gap : 0.0);
      if (y_ > largest_height)
        throw InputError(
            fmt::format("its {} curves need {} panels, more than a page holds; show fewer runs with 'where'",
                        plot_.curves.size(), count));
    }
  }

  // What is left of a page of the usual height.
  double single_height(double top, double names_below) {
    canvas_.set_font(note_font);
    const double note = static_cast<double>(canvas_.lines_of(plot_.note, page_width - 2.0 * page_edge).size()) *
                        height_of_line(note_font);
    const double below =
        names_below + (plot_.x_label.empty() ? 0.0 : height_of_line(text_font) + 12.0) + note + page_edge;
    return std::max(least_panel_height, usual_height - top - below);
  }

  // Above a panel: what its curves share, and its own part of the legend. Returns where they end.
  double add_heading(int panel, double left, double width) {
    double y = y_;
    canvas_.set_font(small_font, true);
    for (const std::string& line : canvas_.lines_of(heading_of(panel), width, most_lines)) {
      page_.texts.push_back({line, left, y + 0.5 * height_of_line(small_font), small_font, 0.0, true, false, false});
      y += height_of_line(small_font);
    }
    if (arrangement_.is_split()) {
      const auto [first, last] = colours_of_panel(arrangement_, dimensions_, panel);
      y = add_entries(colour_entries(first, last), left, left + width, y, note_font);
    }
    return y > y_ ? y + 8.0 : y;
  }

  void add_panel(int panel, PlacedPanel placed) {
    for (std::size_t c = 0; c < plot_.curves.size(); ++c)
      if (page_.looks[c].panel == panel) placed.curves.push_back(c);
    page_.panels.push_back(std::move(placed));
  }

  struct Span {
    double low, high;
    double middle() const { return 0.5 * (low + high); }
  };

  void add_axis_names(const std::vector<std::string>& y_lines, const Span& across, const Span& down) {
    for (std::size_t l = 0; l < y_lines.size(); ++l)
      page_.texts.push_back({y_lines[l], page_edge + (static_cast<double>(l) + 0.5) * height_of_line(text_font),
                             down.middle(), text_font, 0.5, false, false, true});
    canvas_.set_font(text_font);
    y_ += 8.0;
    for (const std::string& line : canvas_.lines_of(plot_.x_label, across.high - across.low, most_lines)) {
      page_.texts.push_back(
          {line, across.middle(), y_ + 0.5 * height_of_line(text_font), text_font, 0.5, false, false, false});
      y_ += height_of_line(text_font);
    }
    y_ += 8.0;
  }

  const Plot& plot_;
  std::vector<Dimension> dimensions_;
  Arrangement arrangement_;
  Canvas canvas_;
  PlotLayout page_;
  std::vector<int> shown_panels_;
  std::set<std::pair<int, int>> shown_values_;  // dimensions and their values that a curve with points has
  int columns_ = 1;
  std::size_t x_lines_ = 1;  // of the labels along x
  double y_ = 0.0;           // where what comes next begins
};

}  // namespace

bool is_shown(const Plot& plot, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (!plot.log_x || x > 0.0) && (!plot.log_y || y > 0.0);
}

bool has_points(const Plot& plot, const Curve& curve) {
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    if (is_shown(plot, curve.x[k], curve.y[k])) return true;
  return false;
}

PlotLayout lay_out(const Plot& plot) { return Layout(plot).made(); }

}  // namespace billow::render
