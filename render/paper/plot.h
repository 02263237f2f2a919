// Plots of curves, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace billow::render {

/// One curve. x and y are of the same length; a point that is not finite leaves a gap.
struct Curve {
  std::string name;
  std::vector<double> x, y;
};

struct Plot {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  bool points = true;  // mark every point
  std::vector<Curve> curves;
};

/// STEM.png, STEM.svg, and STEM.csv with a row `curve,x,y` for every point, in full precision. Each appears whole or
/// not at all, and depends on nothing but `plot`. Throws OutputError, also when gnuplot is missing or refuses.
void write_plot(const Plot& plot, const std::filesystem::path& stem);

}  // namespace billow::render
