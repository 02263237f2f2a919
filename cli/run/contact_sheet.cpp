// A run's frames as panels.
#include "cli/run/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "render/image/png.h"
#include "render/paper/sheet.h"

namespace billow::cli {

namespace {

constexpr int panel_width = 300;  // [pixel]

render::Panel panel_of(const FinishedRun& run, render::View view, long frame) {
  render::Image image = render::read_png(frame_file(run, view, frame));
  const double shape = static_cast<double>(image.height) / image.width;
  const int height = std::max(1, static_cast<int>(std::lround(panel_width * shape)));
  return {std::move(image), panel_width, height, true, ""};
}

// All views of a frame follow one another; the time stands below the first.
void add_frame(render::SheetRow& row, const FinishedRun& run, const std::vector<render::View>& views,
               const std::pair<long, double>& frame) {
  const std::size_t first = row.panels.size();
  for (const render::View view : views) row.panels.push_back(panel_of(run, view, frame.first));
  row.panels[first].caption = fmt::format("{:.2f} s", frame.second);
}

render::Sheet sheet_of(const FinishedRun& run, const std::vector<render::View>& views, const TimedFrames& chosen,
                       std::size_t columns) {
  render::Sheet sheet;
  sheet.title = run.title;
  sheet.note = fmt::format("{} of {} frames, {} fps", chosen.size(), run.frames.size(), run.fps);
  if (std::find(views.begin(), views.end(), render::View::velocity) != views.end())
    sheet.scales.push_back(render::velocity_scale(run.velocity_colour, run.velocity_range));
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (k % columns == 0) sheet.rows.emplace_back();
    add_frame(sheet.rows.back(), run, views, chosen[k]);
  }
  return sheet;
}

// About as wide as high: four of twelve.
std::size_t default_columns(std::size_t panels) {
  return static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(panels))));
}

}  // namespace

TimedFrames evenly_chosen(const TimedFrames& frames, std::size_t wanted) {
  if (wanted >= frames.size()) return frames;
  if (wanted == 1) return {frames.front()};
  TimedFrames chosen;
  const std::size_t last = frames.size() - 1, gaps = wanted - 1;
  for (std::size_t k = 0; k < wanted; ++k) chosen.push_back(frames[(k * last + gaps / 2) / gaps]);
  return chosen;
}

render::Image contact_sheet(const FinishedRun& run, const std::vector<render::View>& views, const TimedFrames& chosen,
                            std::size_t columns) {
  if (chosen.empty()) throw InputError(run.folder.string() + ": the run has no frames");
  return render::draw_sheet(sheet_of(run, views, chosen, columns > 0 ? columns : default_columns(chosen.size())));
}

}  // namespace billow::cli
