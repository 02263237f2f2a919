// Films -> sheets.
#include "cli/study/study_sheets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/readable_number.h"
#include "cli/study/shown_run.h"
#include "render/image/png.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;
using render::VelocityColour;

constexpr int strip_width = 1200, tallest_strip = 260, lowest_strip = 90;
constexpr int all_strips_height = 2000;  // that strips share, where they are many
constexpr int spectrum_side = 300, spectra_a_row = 4;
constexpr int thumbnail_width = 300, thumbnails_a_row = 8, grid_columns = 6;

/// A run and the record of its film.
struct ShownFilm {
  ShownRun run;
  FinishedRun record;
  std::string colours;  // "v = 3.2 m/s" where runs differ in what their colours stand for

  // What differs from other runs.
  std::string label() const { return run.label + (run.label.empty() || colours.empty() ? "" : "; ") + colours; }
};

std::vector<ShownFilm> films_of(const std::vector<ShownRun>& runs) {
  std::vector<ShownFilm> films;
  for (const ShownRun& run : runs) films.push_back({run, finished_film(run), ""});
  return films;
}

// Which colour is which velocity. Where runs have other ranges, each names its own, which the scale calls v.
void add_velocity_scale(render::Sheet& sheet, std::vector<ShownFilm>& films, VelocityColour colour) {
  const double range = films.front().record.velocity_range;
  sheet.scales.push_back(render::velocity_scale(colour, range));
  if (std::all_of(films.begin(), films.end(),
                  [&](const ShownFilm& film) { return film.record.velocity_range == range; }))
    return;
  render::SheetScale& scale = sheet.scales.back();
  scale.title += ", v as named";
  scale.high = colour == VelocityColour::magnitude ? "v" : "+v";
  if (colour == VelocityColour::magnitude)
    scale.middle = "v/2";
  else
    scale.low = "\u2212v";
  for (ShownFilm& film : films) film.colours = fmt::format("v = {} m/s", readable(film.record.velocity_range, 3));
}

// One for each way in which the velocity view of a run is coloured.
void add_scales_of_frames(render::Sheet& sheet, std::vector<ShownFilm>& films) {
  for (const Word<VelocityColour>& colour : words(VelocityColour{}))
    if (std::any_of(films.begin(), films.end(),
                    [&](const ShownFilm& film) { return film.record.velocity_colour == colour.value; }))
      add_velocity_scale(sheet, films, colour.value);
}

// The frame nearest to `time`; nothing when the run ended before.
std::optional<std::pair<long, double>> frame_at(const std::vector<std::pair<long, double>>& frames, double time) {
  if (frames.empty()) return std::nullopt;
  const auto nearest = std::min_element(frames.begin(), frames.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.second - time) < std::abs(b.second - time);
  });
  const double interval = frames.size() > 1 ? frames[1].second - frames[0].second : 1.0;
  if (std::abs(nearest->second - time) > interval) return std::nullopt;
  return *nearest;
}

// The frames nearest to the picture's times, each once.
std::vector<std::pair<long, double>> frames_at(const std::vector<std::pair<long, double>>& frames,
                                               const std::vector<double>& times) {
  std::vector<std::pair<long, double>> found;
  for (const double time : times)
    if (const auto frame = frame_at(frames, time);
        frame && std::find(found.begin(), found.end(), *frame) == found.end())
      found.push_back(*frame);
  return found;
}

render::Panel frame_panel(const ShownFilm& film, const std::string& view, long frame, int width) {
  const fs::path file = film.run.film / view / fmt::format("frame_{:04}.png", frame);
  render::Panel panel{of_run(film.run, file, render::read_png), width, 0, true, ""};
  panel.height = std::max(1, panel.image.height * width / std::max(1, panel.image.width));
  return panel;
}

std::string lettered(std::size_t index, const std::string& label) {
  return fmt::format("({}) {}", static_cast<char>('a' + index % 26), label);
}

render::Image image_of(const ShownRun& run, RunFile picture) {
  return of_run(run, run.film / word_of(picture), [&](const fs::path& file) {
    require_file(file);
    return render::read_png(file);
  });
}

double longest(const std::vector<ShownFilm>& films) {
  double duration = 0.0;
  for (const ShownFilm& film : films) duration = std::max(duration, film.run.result->value("duration").value_or(0.0));
  return duration;
}

// A strip ends with its scene, or where the run diverged.
double strip_duration(const ShownFilm& film) {
  const double duration = film.run.result->value("duration").value_or(0.0);
  return film.run.result->status == RunStatus::done ? duration : std::min(duration, film.record.simulated_time);
}

// The first run's frames, each beginning at its time.
render::SheetRow frames_below(const std::vector<ShownFilm>& films, const PictureSpec& picture) {
  const ShownFilm& film = films.front();
  render::SheetRow frames{films.size() > 1 ? lettered(films.size(), "frames of " + film.run.label) : "", {}, {}, false};
  const int width = std::max(40, strip_width / static_cast<int>(picture.times.size()) - 6);
  for (const auto& [frame, time] : frames_at(film.record.frames, picture.times)) {
    frames.panels.push_back(frame_panel(film, picture.views.front(), frame, width));
    frames.times.push_back(time);
  }
  return frames;
}

// One strip above the other on one time axis; below them frames of the first run.
render::Sheet strips_sheet(std::vector<ShownFilm> films, const PictureSpec& picture) {
  const double duration = longest(films);
  render::Sheet sheet{picture.title, picture.note, 0.0, duration, strip_width, {}};
  add_velocity_scale(sheet, films, VelocityColour::components);
  const int height = std::clamp(all_strips_height / static_cast<int>(films.size()), lowest_strip, tallest_strip);
  for (std::size_t r = 0; r < films.size(); ++r) {
    const int width = std::max(1, static_cast<int>(std::lround(strip_duration(films[r]) / duration * strip_width)));
    sheet.rows.push_back({films.size() > 1 ? lettered(r, films[r].label()) : films[r].label(),
                          {{image_of(films[r].run, RunFile::strip), width, height, true, ""}},
                          {},
                          false});
  }
  sheet.rows.back().axis_below = true;
  if (!picture.times.empty()) sheet.rows.push_back(frames_below(films, picture));
  return sheet;
}

// "−25 … 24 cycles per side", the frequencies of a spectrum's columns; zero is at column w / 2.
std::string frequencies_of(const render::Image& spectrum) {
  const auto range = [](int size) { return fmt::format("\u2212{} … {}", size / 2, (size - 1) / 2); };
  return spectrum.width == spectrum.height
             ? range(spectrum.width) + " cycles per side"
             : fmt::format("{} across, {} down, cycles per side", range(spectrum.width), range(spectrum.height));
}

void add_power_scale(render::Sheet& sheet, const std::vector<ShownFilm>& films) {
  std::map<double, bool> ranges;
  for (const ShownFilm& film : films)
    if (film.record.spectrum_range) ranges[*film.record.spectrum_range] = true;
  for (const auto& [range, used] : ranges) sheet.scales.push_back(render::power_scale(range));
}

// The velocity image above its spectrum, a column for every run.
render::Sheet spectra_sheet(std::vector<ShownFilm> films, const PictureSpec& picture) {
  render::Sheet sheet{picture.title, picture.note, 0.0, 0.0, 0, {}};
  add_velocity_scale(sheet, films, VelocityColour::components);
  add_power_scale(sheet, films);
  for (std::size_t f = 0; f < films.size(); ++f) {
    if (f % spectra_a_row == 0) sheet.rows.resize(sheet.rows.size() + 2);
    const auto panel = [&](RunFile file) {
      return render::Panel{image_of(films[f].run, file), spectrum_side, spectrum_side, false, ""};
    };
    render::SheetRow &above = sheet.rows[sheet.rows.size() - 2], &below = sheet.rows.back();
    above.panels.push_back(panel(RunFile::velocity_image));
    above.panels.back().heading = films[f].label();
    below.panels.push_back(panel(RunFile::spectrum));
    below.panels.back().caption = frequencies_of(below.panels.back().image);
  }
  return sheet;
}

bool shows_velocity(const PictureSpec& picture) {
  return std::find(picture.views.begin(), picture.views.end(), "velocity") != picture.views.end();
}

// All views of a film at one time side by side, what they are below the first.
void add_moment(render::SheetRow& row, const ShownFilm& film, const PictureSpec& picture,
                const std::pair<long, double>& frame, const std::string& what) {
  const std::size_t first = row.panels.size();
  for (const std::string& view : picture.views)
    row.panels.push_back(frame_panel(film, view, frame.first, thumbnail_width));
  row.panels[first].caption = fmt::format("{}{}{:.2f} s", what, what.empty() ? "" : ", ", frame.second);
}

void begin_row_where_full(render::Sheet& sheet, std::size_t most) {
  if (sheet.rows.back().panels.size() >= most) sheet.rows.emplace_back();
}

// Frames of one run in rows of a handful.
void add_film(render::Sheet& sheet, const ShownFilm& film, const PictureSpec& picture, std::size_t most) {
  sheet.rows.push_back({film.label(), {}, {}, false});
  for (const auto& frame : frames_at(film.record.frames, picture.times)) {
    begin_row_where_full(sheet, most);
    add_moment(sheet.rows.back(), film, picture, frame, "");
  }
  if (std::string& label = sheet.rows.back().label; sheet.rows.back().panels.empty())
    label += std::string(label.empty() ? "" : ": ") + "ended before these times";
}

// "λ = 1 (diverged); v = 3 m/s"
std::string what_else(const Study& study, const std::vector<int>& others, const ShownFilm& film) {
  std::string what = label_on(study, others, *film.run.run);
  if (film.run.result->status == RunStatus::diverged) what += " (diverged)";
  return film.colours.empty() ? what : what + "; " + film.colours;
}

// A row for every value of the picture's axis, in it all runs that have that value, each with what else it is.
void add_grid(render::Sheet& sheet, const Study& study, const std::vector<ShownFilm>& films, const PictureSpec& picture,
              const std::vector<int>& others) {
  const Axis& axis = study.axes[*picture.rows];
  for (std::size_t v = 0; v < axis.values.size(); ++v) {
    const std::size_t first = sheet.rows.size();
    sheet.rows.push_back({axis.values[v].shown, {}, {}, false});
    for (const ShownFilm& film : films) {
      if (film.run.run->choice[*picture.rows] != static_cast<int>(v)) continue;
      const auto frame = frame_at(film.record.frames, picture.times.front());
      if (!frame) continue;
      begin_row_where_full(sheet, grid_columns);
      add_moment(sheet.rows.back(), film, picture, *frame, what_else(study, others, film));
    }
    if (sheet.rows[first].panels.empty()) sheet.rows.resize(first);
  }
}

render::Sheet frames_sheet(const Study& study, std::vector<ShownFilm> films, const PictureSpec& picture,
                           const std::vector<int>& varying) {
  render::Sheet sheet{picture.title, picture.note, 0.0, 0.0, 0, {}};
  if (shows_velocity(picture)) add_scales_of_frames(sheet, films);
  std::vector<int> others = varying;
  if (picture.rows) std::erase(others, *picture.rows);
  // One moment of each run leaves the rows free for what else varies.
  if (picture.rows && !others.empty() && picture.times.size() == 1) {
    add_grid(sheet, study, films, picture, others);
    return sheet;
  }
  const std::size_t views = picture.views.size();
  const std::size_t most = films.size() > 1 ? std::max<std::size_t>(1, thumbnails_a_row / views) * views
                                            : std::max<std::size_t>(1, 4 / views) * views;
  for (const ShownFilm& film : films) add_film(sheet, film, picture, most);
  return sheet;
}

}  // namespace

render::Sheet sheet_of(const StudyContents& contents, const PictureSpec& picture) {
  std::vector<ShownRun> runs = rendered_runs(contents, picture);
  if (runs.empty()) throw InputError("none of its runs is finished: " + unfinished_runs(shown_runs(contents, picture)));
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const ShownRun& a, const ShownRun& b) { return comes_first(picture, *a.run, *b.run); });
  switch (picture.kind) {
    case PictureKind::strips:
      return strips_sheet(films_of(runs), picture);
    case PictureKind::spectra:
      return spectra_sheet(films_of(runs), picture);
    default:
      return frames_sheet(contents.study, films_of(runs), picture, varying_axes(contents.study, runs));
  }
}

}  // namespace billow::cli
