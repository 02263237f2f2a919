// Curves -> a gnuplot script with its data inside -> pictures.
#include "render/paper/plot.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <sstream>
#include <system_error>

#include "base/atomic_file.h"
#include "base/child_process.h"
#include "base/error.h"

namespace billow::render {

namespace {

namespace fs = std::filesystem;

constexpr double patience = 60.0;  // [s] for a plot that takes a fraction of one

// Okabe and Ito's colours, which the colour-blind tell apart; with a dash and a point type of their own for print.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr std::array dashes = {"1", "2", "4", "5", "3", "1", "2"};
constexpr std::array points = {7, 5, 9, 13, 11, 6, 4};

// As gnuplot reads it between single quotes, where nothing but the quote itself has a meaning. Between double quotes it
// would hand what stands in backquotes to a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + '\'';
}

// Logarithms exist of positive numbers only; gnuplot would give up on a curve without one.
bool shown(const Plot& plot, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (!plot.log_x || x > 0.0) && (!plot.log_y || y > 0.0);
}

bool has_points(const Plot& plot, const Curve& curve) {
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    if (shown(plot, curve.x[k], curve.y[k])) return true;
  return false;
}

std::string data_block(const Plot& plot, const Curve& curve, std::size_t number) {
  std::string out = fmt::format("$curve{} << EOD\n", number);
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    out += shown(plot, curve.x[k], curve.y[k]) ? fmt::format("{:.17g} {:.17g}\n", curve.x[k], curve.y[k]) : "\n";
  return out + "EOD\n";
}

std::string curve_command(const Plot& plot, const Curve& curve, std::size_t number) {
  const std::size_t look = number % colours.size();
  return fmt::format("$curve{} using 1:2 with {} lc rgb \"{}\" lw 2 dt {} pt {} ps 0.9 title {}", number,
                     plot.points ? "linespoints" : "lines", colours[look], dashes[look], points[look],
                     quoted(curve.name));
}

std::string settings(const Plot& plot) {
  std::string out =
      "set encoding utf8\n"
      "set border 3 lc rgb \"#5a6368\"\n"
      "set tics nomirror textcolor rgb \"#23282c\"\n"
      "set grid lt 1 lc rgb \"#dcdfe1\" lw 1\n"
      "set key tmargin left Left reverse horizontal width 1 spacing 1.25\n"
      "set autoscale xfix\n";
  // A logarithmic axis ends at whole powers of ten: offsets would add a power for nothing.
  out += fmt::format("set offsets graph 0.02, graph 0.02, {}\n", plot.log_y ? "0, 0" : "graph 0.04, graph 0.02");
  out += fmt::format("set key title {} left\nset xlabel {}\nset ylabel {}\n", quoted(plot.title), quoted(plot.x_label),
                     quoted(plot.y_label));
  if (plot.log_x) out += "set logscale x\nset format x \"%g\"\n";
  if (plot.log_y) out += "set logscale y\nset format y \"%g\"\n";
  return out;
}

std::string script(const Plot& plot, const std::string& terminal) {
  std::string out = terminal + settings(plot), commands;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    if (!has_points(plot, plot.curves[c])) continue;
    out += data_block(plot, plot.curves[c], c);
    commands += (commands.empty() ? "" : ", ") + curve_command(plot, plot.curves[c], c);
  }
  return commands.empty() ? "" : out + "plot " + commands + "\n";
}

// gnuplot's first line that says something.
std::string complaint(const ProgramResult& result) {
  if (!result.found) return "gnuplot is not installed; install the package gnuplot-nox";
  if (result.timed_out) return "gnuplot did not finish";
  std::istringstream lines(result.errors);
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(" \t^") != std::string::npos) return "gnuplot says: " + line;
  return fmt::format("gnuplot ended with status {}", result.status);
}

// gnuplot writes to a temporary file of ours; it is renamed only when it is whole.
void draw(const Plot& plot, const std::string& terminal, const fs::path& file) {
  AtomicFile output(file);
  const std::string text =
      script(plot, fmt::format("set terminal {}\nset output {}\n", terminal, quoted(output.temporary().string())));
  if (text.empty()) throw OutputError(fmt::format("{}: there is no point to plot", file.string()));
  const ProgramResult result = run_program({"gnuplot", "-d"}, text, patience);
  std::error_code error;
  if (!result.found || result.timed_out || result.status != 0 || fs::file_size(output.temporary(), error) == 0)
    throw OutputError(fmt::format("{} cannot be plotted: {}", file.string(), complaint(result)));
  output.commit();
}

std::string csv_field(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

std::string csv(const Plot& plot) {
  std::string out = "curve,x,y\n";
  for (const Curve& curve : plot.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      if (std::isfinite(curve.y[k])) out += fmt::format("{},{},{}\n", csv_field(curve.name), curve.x[k], curve.y[k]);
  return out;
}

fs::path with_extension(const fs::path& stem, const char* extension) {
  fs::path file = stem;
  file += extension;
  return file;
}

}  // namespace

void write_plot(const Plot& plot, const fs::path& stem) {
  write_file_atomically(with_extension(stem, ".csv"), csv(plot));
  draw(plot, "pngcairo noenhanced size 1280,800 font \"DejaVu Sans,15\" background rgb \"white\"",
       with_extension(stem, ".png"));
  draw(plot, "svg noenhanced size 1280,800 font \"DejaVu Sans,Verdana,sans-serif,18\" background rgb \"white\"",
       with_extension(stem, ".svg"));
}

}  // namespace billow::render
