// Line plots for pages: inline SVG for the lines, HTML for the words, so that a plot stretches and its text does not.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace billow::cli {

struct PlotPoint {
  double time = 0.0, value = 0.0;
};

struct PlotLine {
  std::string name;
  std::string colour;  // the part after "line-" of a class in page.css: "1" to "3", "x", "y", "z"
  std::vector<PlotPoint> points;
};

struct LinePlot {
  std::string title, unit;
  double begin = 0.0, end = 0.0;  // [s] the time axis, or numbers of frames; end > begin
  std::vector<PlotLine> lines;
  bool exact = true;      // false: the lines keep extremes only, and what is read from them is marked with ≈
  bool dots = false;      // mark the points: there was more between them, which is not known
  bool by_frame = false;  // over numbers of frames instead of time
};

/// A value axis: from low to high, both multiples of `step`, after division by 10^exponent.
struct ValueAxis {
  double low = 0.0, high = 1.0, step = 1.0;
  int decimals = 0;  // that a tick needs
  int exponent = 0;  // a multiple of 3; not 0 where plain numbers would be unwieldy
};

/// Round numbers around all finite values of all lines.
ValueAxis value_axis(const std::vector<PlotLine>& lines);

/// Round times [s] within [begin, end], at most `most` of them, and the decimals that they need.
struct TimeTicks {
  std::vector<double> times;
  int decimals = 0;
};
TimeTicks time_ticks(double begin, double end, int most = 11);

/// `value` with a true minus sign.
std::string number_text(double value, int decimals);

/// Labels for `ticks`, each at its place along the axis, `unit` behind the last: what belongs into a div.ticks.
std::string time_labels(const TimeTicks& ticks, double begin, double end, std::string_view unit = " s");

/// The plot as a figure.plot of page.css. run.js reads values from it at the cursor: the points are in thousandths of
/// the time axis, and downwards in 1/400 from data-high to data-low. Where no line has two points there are no axes:
/// the figure says so, and which values there are.
std::string line_plot(const LinePlot& plot);

}  // namespace billow::cli
