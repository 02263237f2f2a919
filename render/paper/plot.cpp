// Curves -> a page laid out -> a gnuplot script with its data inside -> pictures.
#include "render/paper/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <sstream>

#include "base/atomic_file.h"
#include "base/child_process.h"
#include "base/csv.h"
#include "base/error.h"
#include "base/xml.h"
#include "render/paper/plot_layout.h"

namespace billow::render {

namespace {

namespace fs = std::filesystem;

constexpr double patience = 60.0;  // [s] for a plot that takes a fraction of one

// Okabe and Ito's colours and one of Tol's: under the usual kinds of colour blindness no two are nearer than 10.9 of
// CIEDE2000.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#882255"};
static_assert(colours.size() == most_colours);
// What a mark and its dashes are in gnuplot. The first six differ in both; two more go with colours of their own.
constexpr std::array marks = {7, 5, 9, 13, 11, 6, 4, 8};
constexpr std::array dashes = {"1", "2", "4", "5", "3", "(12,3,3,3)", "(2,2,8,2)", "(16,4)"};
static_assert(marks.size() == most_colours && dashes.size() == most_colours && most_marks <= most_colours);
constexpr std::string_view svg_faces = "DejaVu Sans,Verdana,sans-serif";
constexpr std::string_view bold_face = "DejaVu Sans:Bold";
constexpr const char* any_colour = "#4a5257";  // of what stands for all colours
constexpr std::size_t most_wider = 2;          // curves that show below one another; more are named
constexpr double pointless_marks = 8.0;        // on a curve whose points are not marked

// As gnuplot reads it between double quotes. Everything but letters, digits and blanks is written by its number, so
// that nothing is left for gnuplot to read: quotes, macros, and backquotes, which it would hand to a shell. Line breaks
// become blanks, and so do other control characters and what is no text.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : xml_characters(text)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    if (plain)
      out += c;
    else if (byte <= 0x20 || byte == 0x7F)
      out += ' ';
    else
      out += fmt::format("\\{:03o}", byte);
  }
  return out + '"';
}

// The label of a tick, in which line breaks stay, and which gnuplot takes for a format.
std::string tick_label(const std::string& text) {
  const std::string percent = quoted("%").substr(1, 4);
  std::string out;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = quoted(text.substr(begin, end - begin));
    for (std::size_t at = 0; (at = line.find(percent, at)) != std::string::npos; at += 2 * percent.size())
      line.insert(at, percent);
    out += (begin > 0 ? "\\n" : "") + line.substr(1, line.size() - 2);
    begin = end + 1;
  }
  return '"' + out + '"';
}

std::string data_block(const Plot& plot, const Curve& curve, std::size_t number) {
  std::string out = fmt::format("$curve{} << EOD\n", number);
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    out += is_shown(plot, curve.x[k], curve.y[k]) ? fmt::format("{:.17g} {:.17g}\n", curve.x[k], curve.y[k]) : "\n";
  return out + "EOD\n";
}

/// How a terminal counts sizes, and where things are on a page of that size.
struct Page {
  const PlotLayout& layout;
  double font_unit;  // of a pixel
  double mark_size;

  std::string at(double x, double y) const {
    return fmt::format("screen {:.6f}, screen {:.6f}", x / layout.width, 1.0 - y / layout.height);
  }
  double across(double x) const { return x / layout.width; }
  double up(double y) const { return 1.0 - y / layout.height; }
  std::string font(double size, bool bold) const {
    return fmt::format("font \"{},{:.4g}\"", bold ? bold_face : std::string_view(), size * font_unit);
  }
};

// In the same place on the page, as far as eyes can tell.
bool stand_together(double p, double q, const PlotAxis& axis, bool logarithmic) {
  constexpr double visible = 2e-3;  // of an axis
  if (!logarithmic) return std::isnan(p) == std::isnan(q) && !(std::abs(p - q) > visible * (axis.high - axis.low));
  const bool shown = p > 0.0, other_shown = q > 0.0;
  if (!shown || !other_shown) return shown == other_shown;
  return !(std::abs(std::log(p / q)) > visible * std::log(axis.high / axis.low));
}

bool coincide(const Plot& plot, std::size_t one, std::size_t other, const PlacedPanel& panel) {
  const Curve &a = plot.curves[one], &b = plot.curves[other];
  bool same = a.x.size() == b.x.size();
  for (std::size_t k = 0; same && k < a.x.size(); ++k)
    same = stand_together(a.x[k], b.x[k], panel.x, plot.log_x) && stand_together(a.y[k], b.y[k], panel.y, plot.log_y);
  return same;
}

// What is drawn over a curve in the same places, the lowest first.
std::vector<std::size_t> covers_of(const Plot& plot, const PlacedPanel& panel, std::size_t number) {
  std::vector<std::size_t> covers;
  const auto self = std::find(panel.curves.begin(), panel.curves.end(), number);
  std::copy_if(self + 1, panel.curves.end(), std::back_inserter(covers),
               [&](std::size_t other) { return coincide(plot, number, other, panel); });
  return covers;
}

// "Covered: exp, gauss as box." Of curves that lie below so many others that nothing of them shows.
std::string covered_text(const Plot& plot, const PlotLayout& layout) {
  std::map<std::size_t, std::vector<std::string_view>> covered;  // by what covers them
  for (const PlacedPanel& panel : layout.panels)
    for (const std::size_t c : panel.curves)
      if (const auto covers = covers_of(plot, panel, c); has_points(plot, plot.curves[c]) && covers.size() > most_wider)
        covered[covers[covers.size() - most_wider - 1]].push_back(plot.curves[c].name);
  std::vector<std::string> groups;
  for (const auto& [cover, names] : covered)
    groups.push_back(fmt::format("{} as {}", fmt::join(names, "; "), plot.curves[cover].name));
  return groups.empty() ? "" : fmt::format("Covered: {}.", fmt::join(groups, ". "));
}

Plot with_note(Plot plot, const std::string& more) {
  plot.note += (plot.note.empty() || more.empty() ? "" : " ") + more;
  return plot;
}

std::string curve_command(const Plot& plot, const Page& page, const PlacedPanel& panel, std::size_t number) {
  const Look& look = page.layout.looks[number];
  const std::size_t points = plot.curves[number].x.size();
  const int every =
      plot.points ? 1 : std::max(1, static_cast<int>(std::ceil(static_cast<double>(points) / pointless_marks)));
  // Wider for what covers it, and without gaps then, so that it shows on either side.
  const std::size_t covers = std::min(most_wider, covers_of(plot, panel, number).size());
  // Nothing lies between things that x counts.
  return fmt::format("$curve{} using 1:2 with {} lc rgb \"{}\" lw {} dt {} pt {} ps {:.4g} pi {} notitle", number,
                     plot.x_names.empty() ? "linespoints" : "points", colours[look.colour], 2 + 3 * covers,
                     covers > 0 ? dashes[0] : dashes[look.mark], marks[look.mark],
                     page.mark_size * (1.0 + 0.5 * static_cast<double>(covers)), every);
}

std::string text_command(const Page& page, const PlacedText& text) {
  return fmt::format("set label {} at {} {}{} {} textcolor rgb \"{}\" front\n", quoted(text.text),
                     page.at(text.x, text.y), text.align > 0.0 ? "center" : "left", text.upright ? " rotate by 90" : "",
                     page.font(text.size, text.bold), text.quiet ? "#5a6368" : "#23282c");
}

// A mark alone has its dashes too; a colour alone is a plain line, wider so that it shows.
std::string sample_commands(const Page& page, const Sample& sample, std::size_t number) {
  const char* colour = sample.colour >= 0 ? colours[sample.colour] : any_colour;
  if (sample.mark < 0) return fmt::format("$sample{} every 2 with lines lc rgb \"{}\" lw 4 notitle", number, colour);
  return fmt::format(
      "$sample{0} every 2 with lines lc rgb \"{1}\" lw 2 dt {2} notitle, $sample{0} every ::1::1 with points lc rgb "
      "\"{1}\" pt "
      "{3} "
      "ps {4} notitle",
      number, colour, dashes[sample.mark], marks[sample.mark], page.mark_size);
}

// The legend: a plot of samples whose axes are the page's pixels.
std::string legend_commands(const Page& page) {
  const PlotLayout& layout = page.layout;
  if (layout.samples.empty()) return "";
  std::string data, commands;
  for (std::size_t s = 0; s < layout.samples.size(); ++s) {
    const Sample& sample = layout.samples[s];
    data += fmt::format("$sample{} << EOD\n{} {}\n{} {}\n{} {}\nEOD\n", s, sample.x, sample.y,
                        sample.x + 0.5 * sample_length, sample.y, sample.x + sample_length, sample.y);
    commands += (s ? ", " : "plot ") + sample_commands(page, sample, s);
  }
  return data +
         fmt::format(
             "set lmargin at screen 0\nset rmargin at screen 1\nset tmargin at screen 1\nset bmargin at screen 0\n"
             "unset border\nunset tics\nset xrange [0:{}]\nset yrange [{}:0]\n",
             layout.width, layout.height) +
         commands + "\n";
}

std::string tick_list(const PlotAxis& axis, bool named) {
  std::string out = "(";
  for (const Tick& tick : axis.ticks)  // in lines, where its label has several
    out += fmt::format("{}{} {:.17g} {}", out.size() > 1 ? ", " : "", named ? tick_label(tick.label) : "\"\"", tick.at,
                       tick.label.empty() ? 1 : 0);
  return out + ")";
}

std::string panel_commands(const Plot& plot, const Page& page, const PlacedPanel& panel) {
  std::string out = fmt::format(
      "set lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\nset tmargin at screen {:.6f}\nset bmargin at screen "
      "{:.6f}\nset xrange [{:.17g}:{:.17g}]\nset yrange [{:.17g}:{:.17g}]\nset xtics nomirror {} {}\nset ytics "
      "nomirror "
      "{}\nplot ",
      page.across(panel.left), page.across(panel.right), page.up(panel.top), page.up(panel.bottom), panel.x.low,
      panel.x.high, panel.y.low, panel.y.high, page.layout.upright_x ? "rotate by 90 right" : "norotate",
      tick_list(panel.x, panel.names_x), tick_list(panel.y, panel.names_y));
  const char* separator = "";
  for (const std::size_t c : panel.curves) {
    if (!has_points(plot, plot.curves[c])) continue;
    out += separator + curve_command(plot, page, panel, c);
    separator = ", ";
  }
  return out + "\n";
}

// All words stand on the page, where they have been measured; gnuplot draws axes and curves.
std::string script(const Plot& plot, const Page& page, const std::string& terminal) {
  std::string out = terminal + "set encoding utf8\nunset key\nset multiplot\n" + legend_commands(page) +
                    "set border 3 lc rgb \"#5a6368\"\nset grid lt 1 lc rgb \"#dcdfe1\" lw 1\n" +
                    fmt::format("set tics textcolor rgb \"#23282c\" {}\n", page.font(page.layout.tick_size, false));
  if (plot.log_x) out += "set logscale x\n";
  if (plot.log_y) out += "set logscale y\n";
  for (std::size_t c = 0; c < plot.curves.size(); ++c)
    if (has_points(plot, plot.curves[c])) out += data_block(plot, plot.curves[c], c);
  for (const PlacedText& text : page.layout.texts) out += text_command(page, text);
  for (const PlacedPanel& panel : page.layout.panels) out += panel_commands(plot, page, panel) + "unset label\n";
  return out + "unset multiplot\n";
}

// "         line 0: unknown key option" -> "unknown key option"
std::string without_place(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const std::size_t number = line.find("line "), colon = line.find(": ");
  return std::string(number != std::string_view::npos && colon != std::string_view::npos && number < colon
                         ? line.substr(colon + 2)
                         : line);
}

// What gnuplot says is wrong, not the command that it repeats before it nor the mark below that.
std::string complaint(const ProgramResult& result) {
  if (!result.found) return "gnuplot is not installed; install the package gnuplot-nox";
  if (result.timed_out) return "gnuplot did not finish";
  std::istringstream lines(result.errors);
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(" \t^") != std::string::npos && !line.starts_with("gnuplot> "))
      return "gnuplot says: " + without_place(line);
  return fmt::format("gnuplot ended with status {}", result.status);
}

// The bytes of the picture `file`.
std::string drawn(const std::string& script, const fs::path& file) {
  const ProgramResult result = run_program({"gnuplot", "-d"}, script, patience);
  if (!result.found || result.timed_out || result.status != 0 || result.output.empty())
    throw OutputError(fmt::format("{} cannot be plotted: {}", file.string(), complaint(result)));
  return result.output;
}

// With `with` for every `what` that is part of a tag (gnuplot escapes every other <), or of none.
std::string replaced(std::string svg, std::string_view what, std::string_view with, bool in_a_tag) {
  for (std::size_t at = 0; (at = svg.find(what, at)) != std::string::npos;) {
    const std::size_t open = svg.rfind('<', at), close = svg.rfind('>', at);
    const bool inside = open != std::string::npos && (close == std::string::npos || close < open);
    if (inside == in_a_tag) svg.replace(at, what.size(), with);
    at += inside == in_a_tag ? with.size() : 1;
  }
  return svg;
}

// gnuplot escapes & and < alone, but ]]> must not stand in a text either; and it knows bold faces of other terminals
// only.
std::string well_formed(std::string svg) {
  svg = replaced(std::move(svg), "]]>", "]]&gt;", false);
  return replaced(std::move(svg), fmt::format("font-family=\"{}\"", bold_face),
                  fmt::format("font-family=\"{}\" font-weight=\"bold\"", svg_faces), true);
}

std::string x_field(const Plot& plot, double x) {
  return plot.x_names.empty() ? fmt::format("{}", x) : csv_field(plot.x_names[static_cast<std::size_t>(x)]);
}

std::string csv(const Plot& plot) {
  std::string out = "curve,x,y\n";
  for (const Curve& curve : plot.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      if (std::isfinite(curve.y[k]))
        out += fmt::format("{},{},{}\n", csv_field(curve.name), x_field(plot, curve.x[k]), curve.y[k]);
  return out;
}

fs::path with_extension(const fs::path& stem, const char* extension) {
  fs::path file = stem;
  file += extension;
  return file;
}

}  // namespace

void write_plot(const Plot& plot, const fs::path& stem) {
  const fs::path png = with_extension(stem, ".png"), svg = with_extension(stem, ".svg");
  write_file_atomically(with_extension(stem, ".csv"), csv(plot));
  // Axes have to be known before what coincides on them can be told.
  const Plot noted = with_note(plot, covered_text(plot, lay_out(plot)));
  const PlotLayout layout = lay_out(noted);
  if (layout.panels.empty()) throw OutputError(fmt::format("{}: there is no point to plot", png.string()));
  const std::string size = fmt::format("size {},{} background rgb \"white\"", layout.width, layout.height);
  // Cairo's terminal counts fonts in points of 96 to the inch.
  const std::string raster = fmt::format("set terminal pngcairo noenhanced font \"DejaVu Sans,12\" {}\n", size);
  const std::string vectors = fmt::format("set terminal svg noenhanced font \"{},16\" {}\n", svg_faces, size);
  write_file_atomically(png, drawn(script(noted, {layout, 0.75, 0.9}, raster), png));
  write_file_atomically(svg, well_formed(drawn(script(noted, {layout, 1.0, 0.55}, vectors), svg)));
}

}  // namespace billow::render
