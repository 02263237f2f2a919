// Filling cli/page/run.html, player.html and viewer.html.
#include "cli/run/run_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/readable_number.h"
#include "base/xml.h"
#include "cli/page/page_file.h"
#include "cli/page/report_page.h"
#include "cli/text/json_text.h"

namespace billow::cli {

namespace {

// The frames that the slider goes to; 0 where there are none.
long shown_first(const RunPage& page) {
  return page.series.last_frame() == 0 && !page.listed.empty() ? page.listed.front() : page.series.first_frame();
}
long shown_last(const RunPage& page) {
  return page.series.last_frame() == 0 && !page.listed.empty() ? page.listed.back() : page.series.last_frame();
}

bool has_one_frame(const RunPage& page) { return shown_first(page) == shown_last(page); }

/// The time axis that the slider, the strip and the plots share [s]: from the first frame to the last, or to the end of
/// the strip, whichever comes later. A single frame has no extent of its own, and stands in the whole strip.
struct TimeAxis {
  double begin = 0.0, last = 0.0, end = 0.0;

  explicit TimeAxis(const RunPage& page)
      : begin(has_one_frame(page) && page.strip_columns > 0 ? 0.0 : time_of(shown_first(page), page)),
        last(time_of(shown_last(page), page)),
        end(std::max(last, page.strip_columns * page.strip_step)) {
    if (end <= begin) end = begin + 1.0 / page.fps;
  }
  static double time_of(long frame, const RunPage& page) { return static_cast<double>(frame - 1) / page.fps; }
  double share(double time) const { return (time - begin) / (end - begin); }
};

// A picture to begin with: the frame of most motion, as a drape's first frame shows only its edge. Where nothing is
// known of the motion, the run failed: the last that it came to.
long start_frame(const RunPage& page) {
  const std::vector<PlotPoint> kinetic = page.series.points(Quantity::kinetic);
  if (kinetic.empty()) return shown_last(page);
  const auto most = std::max_element(kinetic.begin(), kinetic.end(),
                                     [](const PlotPoint& a, const PlotPoint& b) { return a.value < b.value; });
  const long frame =
      std::clamp(std::lround(most->time * page.fps) + 1, page.series.first_frame(), page.series.last_frame());
  const auto next = std::lower_bound(page.listed.begin(), page.listed.end(), frame);
  return page.listed.empty() ? frame : next == page.listed.end() ? page.listed.back() : *next;
}

int clock_decimals(const RunPage& page) { return page.fps > 100.0 ? 4 : 2; }

std::string_view note_class(PageNote::Kind kind) {
  switch (kind) {
    case PageNote::Kind::partial:
      return "";
    case PageNote::Kind::look_closer:
      return " warn";
    case PageNote::Kind::failed:
      return " bad";
  }
  return "";
}

std::string notes(const RunPage& page) {
  std::string html;
  for (const PageNote& note : page.notes)
    html += fmt::format("<p class=\"note{}\">{}</p>\n", note_class(note.kind), xml_escape(note.text));
  return html;
}

std::string views(const RunPage& page, long frame) {
  if (page.views.empty()) return fmt::format("<p class=\"empty\">{}</p>\n", xml_escape(page.no_views));
  std::string html;
  for (const std::string& view : page.views)
    html += fmt::format(
        "<figure class=\"view\"><img src=\"{0}/frame_{1:04}.png\" width=\"{2}\" height=\"{3}\" decoding=\"sync\" "
        "alt=\"{0}, frame {1}\"><figcaption>{0}</figcaption></figure>\n",
        xml_escape(view), frame, page.width, page.height);
  return html;
}

// The strip begins at time 0, the axis at the first frame: what lies before is cut off.
std::string strip(const RunPage& page, const TimeAxis& axis) {
  if (page.strip_columns == 0) return "";
  return fmt::format(
      "<div class=\"lane strip\"><span class=\"lane-name\">velocity strip</span><div class=\"seek\" "
      "id=\"strip\"><img src=\"velocity_strip.png\" style=\"left: {:.4f}%; width: {:.4f}%\" "
      "alt=\"velocity strip: time to the right, one row per particle\"><i class=\"cursor\"></i></div></div>\n",
      100.0 * axis.share(0.0), 100.0 * page.strip_columns * page.strip_step / (axis.end - axis.begin));
}

std::string plots(const RunPage& page, const TimeAxis& axis) {
  if (page.series.last_frame() == 0)
    return "<p class=\"empty\">Without curves: energies, momenta and stretch are written when a run ends.</p>\n";
  constexpr std::size_t most_dots = 100;
  const bool dots = page.scattered && page.series.points(Quantity::kinetic).size() <= most_dots;
  const auto line = [&](const char* name, const char* colour, Quantity quantity) {
    return PlotLine{name, colour, page.series.points(quantity)};
  };
  using enum Quantity;
  return line_plot({"Energy",
                    "J",
                    axis.begin,
                    axis.end,
                    {line("kinetic", "1", kinetic), line("potential", "2", potential), line("total", "3", total)},
                    page.series.exact(),
                    dots}) +
         line_plot({"Linear momentum",
                    "kg m/s",
                    axis.begin,
                    axis.end,
                    {line("x", "x", linear_x), line("y", "y", linear_y), line("z", "z", linear_z)},
                    page.series.exact(),
                    dots}) +
         line_plot({"Angular momentum",
                    "kg m²/s, about the origin",
                    axis.begin,
                    axis.end,
                    {line("x", "x", angular_x), line("y", "y", angular_y), line("z", "z", angular_z)},
                    page.series.exact(),
                    dots}) +
         line_plot({"Stretch",
                    "of structural springs, rest lengths",
                    axis.begin,
                    axis.end,
                    {line("largest", "1", largest_stretch), line("mean", "2", mean_stretch)},
                    page.series.exact(),
                    dots});
}

// What a single frame has no use for.
std::string hidden_if(bool hidden) { return hidden ? " hidden" : ""; }

std::string player(const RunPage& page) {
  if (shown_last(page) == 0) return "";
  const TimeAxis axis(page);
  const long start = start_frame(page);
  const double start_time = TimeAxis::time_of(start, page);
  const nlohmann::ordered_json data = {{"first", shown_first(page)},
                                       {"last", shown_last(page)},
                                       {"of", page.frames},
                                       {"start", start},
                                       {"fps", page.fps},
                                       {"begin", axis.begin},
                                       {"end", axis.end},
                                       {"views", page.views},
                                       {"listed", page.listed},
                                       {"decimals", clock_decimals(page)}};
  const bool still = has_one_frame(page);
  return fill_template(page_file("player.html"),
                       {{"at", fmt::format("{:.5f}", axis.share(start_time))},
                        {"views", views(page, start)},
                        {"track_width", fmt::format("{:.4f}", 100.0 * axis.share(axis.last))},
                        {"first", std::to_string(shown_first(page))},
                        {"last", std::to_string(shown_last(page))},
                        {"start", std::to_string(start)},
                        {"still", hidden_if(still)},
                        {"timeless", hidden_if(still && page.strip_columns == 0)},
                        {"strip", strip(page, axis)},
                        {"ticks", time_labels(time_ticks(axis.begin, axis.end), axis.begin, axis.end)},
                        {"clock", fmt::format("{:.{}f} s, frame {} of {}", start_time, clock_decimals(page),
                                              grouped(start), grouped(page.frames))},
                        {"plots", plots(page, axis)},
                        {"data", json_for_script(json_text(data))}});
}

std::string viewer(const RunPage& page) {
  if (page.glb.empty()) return "";
  return fill_template(page_file("viewer.html"),
                       {{"glb", xml_escape(page.glb)}, {"script", xml_escape(page.glb_script)}});
}

// One pixel a cell: enlarged without smoothing.
std::string spectrum(const RunPage& page) {
  if (page.spectrum_time < 0.0) return "";
  return fmt::format(
      "<section>\n<h2>Spectrum</h2>\n<div class=\"views pixels\">\n<figure class=\"view\"><img "
      "src=\"velocity_image.png\" alt=\"the cloth's velocities as an image\"><figcaption>velocities at {:g} "
      "s</figcaption></figure>\n<figure class=\"view\"><img src=\"velocity_spectrum.png\" alt=\"their "
      "spectrum\"><figcaption>mean spectrum, zero frequency at the centre; <a href=\"spectrum.csv\">by radial "
      "frequency</a></figcaption></figure>\n</div>\n</section>\n",
      page.spectrum_time);
}

std::string facts(const RunPage& page) {
  std::string html;
  for (const auto& [name, value] : page.facts)
    html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", xml_escape(name), xml_escape(value));
  return html;
}

std::string files(const RunPage& page) {
  std::string html = "<a href=\"run.json\">run.json</a> has every number";
  if (page.series.last_frame() > 0) html += ", <a href=\"frames.csv\">frames.csv</a> those of the plots";
  if (page.strip_columns > 0)
    html += ", <a href=\"velocity_strip.png\">velocity_strip.png</a> every particle in its own row of pixels";
  return html + ".";
}

}  // namespace

std::string run_page_html(const RunPage& page) {
  const std::string body = fill_template(page_file("run.html"), {{"title", xml_escape(page.title)},
                                                                 {"summary", xml_escape(page.summary)},
                                                                 {"notes", notes(page)},
                                                                 {"player", player(page)},
                                                                 {"viewer", viewer(page)},
                                                                 {"spectrum", spectrum(page)},
                                                                 {"facts", facts(page)},
                                                                 {"command", xml_escape(page.command)},
                                                                 {"scene", xml_escape(page.scene)},
                                                                 {"files", files(page)}});
  std::vector<std::string_view> scripts{"run.js"};
  if (!page.glb.empty()) scripts.insert(scripts.begin(), "viewer.js");  // it hears of the first frame that run.js shows
  return html_page(page.title + " – billow", body, scripts);
}

}  // namespace billow::cli
