// Ticks, grid, lines and key of a plot.
#include "cli/page/line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/readable_number.h"
#include "base/xml.h"

namespace billow::cli {

namespace {

constexpr double plot_width = 1000.0, plot_height = 400.0;

// The smallest of 1, 2, 5 times a power of ten that divides `span` into at most `most` parts.
double round_step(double span, int most) {
  const double least = span / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

int decimals_of(double step) { return std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9))); }

std::string unit_text(const std::string& unit, int exponent) {
  return exponent == 0 ? unit : power_of_ten(exponent) + " " + unit;
}

/// From plot coordinates to the SVG's.
struct Scale {
  const LinePlot& plot;
  const ValueAxis& axis;

  double x(double time) const { return plot_width * (time - plot.begin) / (plot.end - plot.begin); }
  double y(double value) const {
    return plot_height * (axis.high - value / std::pow(10.0, axis.exponent)) / (axis.high - axis.low);
  }
};

// SVG numbers: short, and never "-0".
std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::vector<PlotPoint> finite_points(const PlotLine& line) {
  std::vector<PlotPoint> points;
  std::copy_if(line.points.begin(), line.points.end(), std::back_inserter(points),
               [](const PlotPoint& point) { return std::isfinite(point.value); });
  return points;
}

std::string polyline(const PlotLine& line, const Scale& scale) {
  std::string points;
  for (const PlotPoint& point : finite_points(line))
    points += fmt::format("{}{},{}", points.empty() ? "" : " ", coordinate(scale.x(point.time)),
                          coordinate(scale.y(point.value)));
  return fmt::format("<polyline class=\"line line-{}\" points=\"{}\"/>\n", line.colour, points);
}

// Lines of no length, whose round ends are dots however the plot is stretched.
std::string dots(const PlotLine& line, const Scale& scale) {
  std::string path;
  for (const PlotPoint& point : finite_points(line))
    path += fmt::format("M{} {}h0", coordinate(scale.x(point.time)), coordinate(scale.y(point.value)));
  return fmt::format("<path class=\"dots line-{}\" d=\"{}\"/>\n", line.colour, path);
}

int steps_of(const ValueAxis& axis) { return static_cast<int>(std::lround((axis.high - axis.low) / axis.step)); }

// Frames are counted: none lies between two ticks that are one apart.
TimeTicks ticks_of(const LinePlot& plot) {
  constexpr int most = 11;
  const double span = plot.end - plot.begin;
  return time_ticks(plot.begin, plot.end, plot.by_frame && span < most - 1 ? static_cast<int>(span) + 1 : most);
}

std::string grid(const LinePlot& plot, const ValueAxis& axis) {
  const Scale scale{plot, axis};
  std::string path;
  for (int k = 0; k <= steps_of(axis); ++k)
    path += fmt::format("M0 {}H{}", coordinate(plot_height * k / steps_of(axis)), plot_width);
  for (const double time : ticks_of(plot).times)
    path += fmt::format("M{} 0V{}", coordinate(scale.x(time)), plot_height);
  std::string svg = fmt::format("<path class=\"grid\" d=\"{}\"/>\n", path);
  if (axis.low < 0.0 && axis.high > 0.0)
    svg += fmt::format("<path class=\"line zero\" d=\"M0 {}H{}\"/>\n", coordinate(scale.y(0.0)), plot_width);
  return svg;
}

std::string value_labels(const ValueAxis& axis) {
  std::string labels;
  const int steps = steps_of(axis);
  for (int k = 0; k <= steps; ++k)
    labels += fmt::format("<span style=\"bottom: {}%\">{}</span>", coordinate(100.0 * k / steps),
                          number_text(axis.low + k * axis.step, axis.decimals));
  return labels;
}

// `value` is what stands there before a script reads the line at the cursor.
std::string key(const PlotLine& line, const std::string& value) {
  return fmt::format(
      "<span class=\"key\"><svg viewBox=\"0 0 24 10\" aria-hidden=\"true\"><path class=\"line line-{}\" "
      "d=\"M0 5H24\"/></svg>{} <output>{}</output></span>",
      line.colour, xml_escape(line.name), value);
}

std::string caption(const LinePlot& plot, const ValueAxis& axis, const std::string& keys) {
  return fmt::format("<figcaption><b>{} <span>[{}]</span></b>{}</figcaption>", xml_escape(plot.title),
                     xml_escape(unit_text(plot.unit, axis.exponent)), keys);
}

bool has_curve(const LinePlot& plot) {
  return std::any_of(plot.lines.begin(), plot.lines.end(),
                     [](const PlotLine& line) { return finite_points(line).size() > 1; });
}

// No axes where nothing would be seen on them.
std::string plot_without_curve(const LinePlot& plot, const ValueAxis& axis) {
  std::string keys;
  bool any = false;
  for (const PlotLine& line : plot.lines) {
    const std::vector<PlotPoint> points = finite_points(line);
    any = any || !points.empty();
    keys += key(line, points.empty()
                          ? "none"
                          : number_text(points.front().value / std::pow(10.0, axis.exponent), axis.decimals + 2));
  }
  return fmt::format("<figure class=\"plot\">\n{}\n<p class=\"empty\">{}</p>\n</figure>\n", caption(plot, axis, keys),
                     any ? "One frame makes no curve." : "No value is finite.");
}

}  // namespace

ValueAxis value_axis(const std::vector<PlotLine>& lines) {
  double low = INFINITY, high = -INFINITY;
  for (const PlotLine& line : lines)
    for (const PlotPoint& point : line.points)
      if (std::isfinite(point.value)) low = std::min(low, point.value), high = std::max(high, point.value);
  if (!(low <= high)) low = high = 0.0;
  const double size = std::max(std::abs(low), std::abs(high));
  ValueAxis axis;
  if (size > 0.0 && (size < 1e-2 || size >= 1e5))
    axis.exponent = 3 * static_cast<int>(std::floor(std::log10(size) / 3.0));
  const double unit = std::pow(10.0, axis.exponent);
  low /= unit, high /= unit;
  // A constant gets an axis as wide as itself.
  const double margin = high - low > 1e-9 * (size / unit) ? 0.0 : size > 0.0 ? 0.5 * size / unit : 1.0;
  axis.step = round_step(high - low + 2.0 * margin, 4);
  // What reaches beyond a grid line by less than anyone sees gets no room of its own.
  constexpr double unseen = 0.02;
  axis.low = axis.step * std::floor((low - margin) / axis.step + unseen);
  axis.high = axis.step * std::ceil((high + margin) / axis.step - unseen);
  axis.decimals = decimals_of(axis.step);
  return axis;
}

TimeTicks time_ticks(double begin, double end, int most) {
  const double step = round_step(end - begin, most - 1);
  TimeTicks ticks;
  ticks.decimals = decimals_of(step);
  for (double k = std::ceil(begin / step - 1e-6); k * step <= end + 1e-6 * step; ++k) ticks.times.push_back(k * step);
  return ticks;
}

std::string number_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_of("123456789") == std::string::npos) text = fmt::format("{:.{}f}", 0.0, decimals);
  return text[0] == '-' ? "\u2212" + text.substr(1) : text;
}

std::string time_labels(const TimeTicks& ticks, double begin, double end, std::string_view unit) {
  std::string labels;
  for (const double time : ticks.times) {
    const std::string place = coordinate(100.0 * (time - begin) / (end - begin));
    labels += fmt::format("<span{} style=\"left: {}%\">{}{}</span>",
                          place == "0"     ? " class=\"first\""
                          : place == "100" ? " class=\"last\""
                                           : "",
                          place, number_text(time, ticks.decimals), time == ticks.times.back() ? unit : "");
  }
  return labels;
}

std::string line_plot(const LinePlot& plot) {
  const ValueAxis axis = value_axis(plot.lines);
  if (!has_curve(plot)) return plot_without_curve(plot, axis);
  std::string keys, lines;
  for (const PlotLine& line : plot.lines) {
    keys += key(line, "");
    lines += polyline(line, {plot, axis});
    if (plot.dots) lines += dots(line, {plot, axis});
  }
  return fmt::format(
      "<figure class=\"plot\" data-low=\"{}\" data-high=\"{}\" data-decimals=\"{}\" data-prefix=\"{}\">\n"
      "{}\n"
      "<div class=\"lane\"><div class=\"y-ticks\" aria-hidden=\"true\">{}</div><div class=\"axes seek\">"
      "<svg viewBox=\"0 0 {} {}\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"{} {}\">\n{}{}</svg>"
      "<i class=\"cursor\"></i></div>\n<div class=\"ticks\" aria-hidden=\"true\">{}</div></div>\n</figure>\n",
      axis.low, axis.high, axis.decimals + 2, plot.exact ? "" : "≈ ", caption(plot, axis, keys), value_labels(axis),
      plot_width, plot_height, xml_escape(plot.title), plot.by_frame ? "by frame" : "over time", grid(plot, axis),
      lines, time_labels(ticks_of(plot), plot.begin, plot.end, plot.by_frame ? "" : " s"));
}

}  // namespace billow::cli
