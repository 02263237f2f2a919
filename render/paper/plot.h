// Plots of curves, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace billow::render {

/// Something in which curves differ.
struct Dimension {
  std::vector<std::string> values;  // as the legend calls them
  bool own_scale = false;           // its values cannot share a y axis: each has panels of its own
};

/// One curve. x and y are of the same length; a point that is not finite leaves a gap.
struct Curve {
  std::string name;
  std::vector<double> x, y;
  std::vector<int> at = {};  // per dimension of the plot, the index of its value
};

struct Plot {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  bool points = true;  // mark every point; otherwise a few, to tell curves apart
  std::vector<Curve> curves;
  std::vector<Dimension> dimensions = {};  // none: the curves' names are the values of the only one
  std::string note = {};
  std::vector<std::string> x_names = {};  // where x counts things, what they are called; x = 0 is the first
};

/// STEM.png, STEM.svg, and STEM.csv with a row `curve,x,y` for every point, in full precision. Each appears whole or
/// not at all, and depends on nothing but `plot`. What curves share has the same look: one dimension is told by colour,
/// another by marks and dashes, the rest by panels (plot_arrangement.h); the legend stands above and covers nothing.
/// Throws OutputError, also when gnuplot is missing or refuses, or where there is no point to plot, or too many panels.
void write_plot(const Plot& plot, const std::filesystem::path& stem);

}  // namespace billow::render
