// Runs -> sheets and plots.
#include "cli/study/study_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <system_error>

#include "base/error.h"
#include "base/regular_file.h"
#include "cli/run/finished_run.h"
#include "cli/run/output_folder.h"
#include "cli/scene/scene_parts.h"
#include "cli/text/command_text.h"
#include "cli/text/number_text.h"
#include "cli/text/text_file.h"
#include "render/image/png.h"
#include "render/paper/plot.h"
#include "render/paper/sheet.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

constexpr int strip_width = 1200, strip_height = 260;
constexpr int spectrum_side = 300;
constexpr int thumbnail_width = 300;
constexpr std::uintmax_t max_table_bytes = 64 << 20;

/// A run that a picture shows, with what is on disk of it.
struct Shown {
  const StudyRun* run = nullptr;
  const RunResult* result = nullptr;
  fs::path film;
  std::string label;  // by the axis of the picture's rows, or of all axes
  std::string again;  // the command that does it again
};

// `read`, which looks at `file` of a run's film. Where it cannot, the message says which run's it is, and how to get
// it.
template <class Read>
auto of_run(const Shown& run, const fs::path& file, const Read& read) {
  try {
    return read(file);
  } catch (const InputError& error) {
    std::error_code ignored;
    const bool in_the_way = fs::exists(file, ignored) && !fs::is_regular_file(file, ignored);
    throw InputError(fmt::format("of run {}, {}; {}do the run again with '{}'", run.run->number, error.what(),
                                 in_the_way ? "remove it, and " : "", run.again));
  }
}

// Where the scene asks for no such output, doing the run again would not help.
void require_output(const Shown& run, std::string_view key) {
  if (("\n" + run.result->scene).find(fmt::format("\n{}: none\n", key)) == std::string::npos) return;
  throw InputError(fmt::format("it needs a {0}, and the scene of run {1} has none; give it one with '{0}: {{}}'", key,
                               run.run->number));
}

// Says whether the file alone is missing, or all of the film.
void require_file(const fs::path& file) {
  const fs::path film = file.parent_path();
  std::error_code error;
  if (fs::exists(file, error)) return;
  const bool film_is_there = fs::exists(film / word_of(RunFile::record), error);
  throw InputError(fmt::format("{} is missing", (film_is_there ? file : film).string()));
}

std::vector<Shown> shown_runs(const StudyContents& contents, const PictureSpec& picture) {
  std::vector<Shown> shown;
  for (std::size_t r = 0; r < contents.runs.size(); ++r) {
    const StudyRun& run = contents.runs[r];
    if (!selects(picture, run)) continue;
    const std::string label = picture.rows ? contents.study.axes[*picture.rows].values[run.choice[*picture.rows]].label
                              : contents.runs.size() == 1 ? ""
                                                          : label_of(contents.study, run);
    shown.push_back({&run, &contents.results[r], run_folder(contents.folder, contents.study, run) / "film", label,
                     command_line({"billow", "study", contents.study.file.string(), "-o", contents.folder.string(),
                                   "--only", std::to_string(run.number)})});
  }
  return shown;
}

// Only runs that left something to show; a diverged one left what came before.
std::vector<Shown> rendered_runs(const StudyContents& contents, const PictureSpec& picture) {
  std::vector<Shown> shown = shown_runs(contents, picture);
  std::erase_if(shown, [](const Shown& run) {
    return run.result->status == RunStatus::missing || run.result->status == RunStatus::failed;
  });
  for (Shown& run : shown)
    if (run.result->status == RunStatus::diverged) run.label += " (diverged)";
  return shown;
}

FinishedRun finished_run(const Shown& run) {
  return of_run(run, run.film / word_of(RunFile::record), [&](const fs::path& record) {
    require_file(record);
    return read_finished_run(run.film);
  });
}

std::vector<std::pair<long, double>> frames_of(const Shown& run) { return finished_run(run).frames; }

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

render::Panel frame_panel(const Shown& run, const std::string& view, long frame, int width) {
  const fs::path file = run.film / view / fmt::format("frame_{:04}.png", frame);
  render::Panel panel{of_run(run, file, render::read_png), width, 0, true, ""};
  panel.height = std::max(1, panel.image.height * width / std::max(1, panel.image.width));
  return panel;
}

std::string lettered(std::size_t index, const std::string& label) {
  return fmt::format("({}) {}", static_cast<char>('a' + index % 26), label);
}

// A picture that a run makes where its scene has `key`.
render::Image image_of(const Shown& run, RunFile picture, std::string_view key) {
  require_output(run, key);
  return of_run(run, run.film / word_of(picture), [&](const fs::path& file) {
    require_file(file);
    return render::read_png(file);
  });
}

// A strip ends with its scene, or where the run diverged.
double strip_duration(const Shown& run) {
  const double duration = run.result->value("duration").value_or(0.0);
  if (run.result->status == RunStatus::done) return duration;
  return std::min(duration, finished_run(run).simulated_time);
}

// One strip above the other on one time axis; below them the first run's frames, each beginning at its time.
render::Sheet strips_sheet(const std::vector<Shown>& runs, const PictureSpec& picture, double duration) {
  render::Sheet sheet{picture.title, picture.note, {}, 0.0, duration, strip_width, {}};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double share = strip_duration(runs[r]) / duration;
    const int width = std::max(1, static_cast<int>(std::lround(share * strip_width)));
    sheet.rows.push_back({lettered(r, runs[r].label),
                          {{image_of(runs[r], RunFile::strip, "strip"), width, strip_height, true, ""}},
                          {},
                          false});
  }
  sheet.rows.back().axis_below = true;
  render::SheetRow frames{lettered(runs.size(), "frames of " + runs.front().label), {}, {}, false};
  if (runs.front().label.empty()) frames.label.clear();
  const int width = std::max(40, strip_width / static_cast<int>(std::max<std::size_t>(1, picture.times.size())) - 6);
  const auto recorded = frames_of(runs.front());
  for (const double time : picture.times)
    if (const auto frame = frame_at(recorded, time)) {
      frames.panels.push_back(frame_panel(runs.front(), picture.views.front(), frame->first, width));
      frames.times.push_back(frame->second);
    }
  sheet.rows.push_back(std::move(frames));
  return sheet;
}

render::Sheet spectra_sheet(const std::vector<Shown>& runs, const PictureSpec& picture) {
  render::Sheet sheet{picture.title, picture.note, {}, 0.0, 0.0, 0, {}};
  render::SheetRow above{"", {}, {}, false}, below = above;
  for (const Shown& run : runs) {
    sheet.columns.push_back(run.label);
    const auto panel = [&](RunFile file) {
      return render::Panel{image_of(run, file, "spectrum"), spectrum_side, spectrum_side, false, ""};
    };
    above.panels.push_back(panel(RunFile::velocity_image));
    below.panels.push_back(panel(RunFile::spectrum));
  }
  sheet.rows = {std::move(above), std::move(below)};
  return sheet;
}

// Frames of one run in rows of a handful, all of its views at each time side by side.
void add_film(render::Sheet& sheet, const Shown& run, const PictureSpec& picture, std::size_t times_a_row) {
  const auto recorded = frames_of(run);
  render::SheetRow row{run.label, {}, {}, false};
  for (const double time : picture.times) {
    const auto frame = frame_at(recorded, time);
    if (!frame) continue;
    if (row.panels.size() >= times_a_row * picture.views.size()) {
      sheet.rows.push_back(std::move(row));
      row = {"", {}, {}, false};
    }
    for (const std::string& view : picture.views)
      row.panels.push_back(frame_panel(run, view, frame->first, thumbnail_width));
    row.panels[row.panels.size() - picture.views.size()].caption = fmt::format("{:.2f} s", frame->second);
  }
  sheet.rows.push_back(std::move(row));
}

render::Sheet frames_sheet(const std::vector<Shown>& runs, const PictureSpec& picture) {
  render::Sheet sheet{picture.title, picture.note, {}, 0.0, 0.0, 0, {}};
  const std::size_t times_a_row =
      runs.size() > 1 ? picture.times.size() : std::max<std::size_t>(1, 4 / picture.views.size());
  for (const Shown& run : runs) add_film(sheet, run, picture, times_a_row);
  return sheet;
}

/// Curves in the order in which their first points come.
class Curves {
 public:
  void add(const std::string& name, double x, double y) {
    const auto [place, fresh] = place_.try_emplace(name, curves_.size());
    if (fresh) curves_.push_back({name, {}, {}});
    curves_[place->second].x.push_back(x);
    curves_[place->second].y.push_back(y);
  }

  // Points by ascending x, whatever the order of the runs.
  std::vector<render::Curve> sorted() const {
    std::vector<render::Curve> sorted;
    for (const render::Curve& curve : curves_) {
      std::vector<std::pair<double, double>> points;
      for (std::size_t k = 0; k < curve.x.size(); ++k) points.emplace_back(curve.x[k], curve.y[k]);
      std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      sorted.push_back({curve.name, {}, {}});
      for (const auto& [x, y] : points) sorted.back().x.push_back(x), sorted.back().y.push_back(y);
    }
    return sorted;
  }

 private:
  std::map<std::string, std::size_t> place_;
  std::vector<render::Curve> curves_;
};

std::string curve_label(const Study& study, const PictureSpec& picture, const StudyRun& run) {
  std::vector<std::string> labels;
  for (const int axis : picture.by) labels.push_back(study.axes[axis].values[run.choice[axis]].curve);
  return fmt::format("{}", fmt::join(labels, ", "));
}

// A column's value, or the number that an axis gives.
std::optional<double> value_in(const Study& study, const Shown& shown, const std::string& column) {
  if (find_column(column)) return shown.result->value(column);
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (study.axes[a].name == column) {
      const ParsedNumber number = parse_number(study.axes[a].values[shown.run->choice[a]].label);
      if (number.fault == NumberFault::none) return number.value;
    }
  return std::nullopt;
}

std::string column_label(const std::string& name) {
  const ResultColumn* column = find_column(name);
  if (!column) return name;
  return std::string(column->label) + (column->unit.empty() ? "" : fmt::format(" [{}]", column->unit));
}

std::string curve_name(const PictureSpec& picture, const std::string& y, const std::string& by) {
  if (picture.y.size() < 2) return by.empty() ? column_label(y) : by;
  const ResultColumn* column = find_column(y);
  const std::string label = column ? std::string(column->label) : y;
  return by.empty() ? label : by + ": " + label;
}

// A diverged run took no step to its end, so its times and limits would mislead.
render::Plot value_plot(const StudyContents& contents, const PictureSpec& picture) {
  Curves curves;
  for (const std::string& y : picture.y)
    for (const Shown& shown : shown_runs(contents, picture)) {
      if (shown.result->status != RunStatus::done) continue;
      const std::optional<double> x = value_in(contents.study, shown, picture.x);
      const std::optional<double> value = value_in(contents.study, shown, y);
      if (x && value) curves.add(curve_name(picture, y, curve_label(contents.study, picture, *shown.run)), *x, *value);
    }
  return {picture.title,
          picture.x_label.empty() ? column_label(picture.x) : picture.x_label,
          picture.y_label.empty() ? column_label(picture.y.front()) : picture.y_label,
          picture.log_x,
          picture.log_y,
          true,
          curves.sorted()};
}

// "0,1.5": a frequency and its power.
std::pair<double, double> spectrum_row(const std::string& line) {
  const std::size_t comma = std::min(line.find(','), line.size());
  const ParsedNumber frequency = parse_number(line.substr(0, comma));
  const ParsedNumber power = parse_number(line.substr(std::min(comma + 1, line.size())));
  if (frequency.fault != NumberFault::none || power.fault != NumberFault::none)
    throw InputError(fmt::format("'{}' is no row of a spectrum; the file is damaged", shortened(line)));
  return {frequency.value, power.value};
}

// The rows of a run's spectrum.csv, after its heading.
std::vector<std::pair<double, double>> spectrum_of_run(const Shown& run) {
  require_output(run, "spectrum");
  return of_run(run, run.film / word_of(RunFile::spectrum_table), [&](const fs::path& file) {
    require_file(file);
    std::istringstream lines(read_regular_file(file, max_table_bytes, "; this is no spectrum"));
    std::vector<std::pair<double, double>> points;
    std::string line;
    std::getline(lines, line);
    for (long number = 2; std::getline(lines, line); ++number)
      points.push_back(located(fmt::format("{}:{}", file.string(), number), [&] { return spectrum_row(line); }));
    if (points.empty()) throw InputError(fmt::format("{}: has no rows; the file is damaged", file.string()));
    return points;
  });
}

render::Plot spectrum_plot(const StudyContents& contents, const PictureSpec& picture) {
  Curves curves;
  for (const Shown& run : rendered_runs(contents, picture)) {
    const std::string by = curve_label(contents.study, picture, *run.run);
    for (const auto& [frequency, power] : spectrum_of_run(run))
      curves.add(by.empty() ? "the scene" : by, frequency, power);
  }
  return {picture.title,
          picture.x_label.empty() ? "radial frequency [cycles per side]" : picture.x_label,
          picture.y_label.empty() ? "mean square velocity [m²/s²]" : picture.y_label,
          picture.log_x,
          picture.log_y,
          false,
          curves.sorted()};
}

// "run 1 is missing, run 2 failed (exit status 4: …)", the first few of them.
std::string unfinished_runs(const std::vector<Shown>& runs) {
  constexpr std::size_t most_named = 3;
  std::vector<std::string> parts;
  for (const Shown& run : runs) {
    if (parts.size() == most_named) break;
    const bool failed = run.result->status == RunStatus::failed;
    parts.push_back(failed ? fmt::format("run {} failed ({})", run.run->number, run.result->message)
                           : fmt::format("run {} is missing", run.run->number));
  }
  return fmt::format("{}{}", fmt::join(parts, ", "), runs.size() > parts.size() ? ", …" : "");
}

double longest(const std::vector<Shown>& runs) {
  double duration = 0.0;
  for (const Shown& run : runs) duration = std::max(duration, run.result->value("duration").value_or(0.0));
  return duration;
}

render::Sheet sheet_of(const StudyContents& contents, const PictureSpec& picture) {
  const std::vector<Shown> runs = rendered_runs(contents, picture);
  if (runs.empty()) throw InputError("none of its runs is finished: " + unfinished_runs(shown_runs(contents, picture)));
  switch (picture.kind) {
    case PictureKind::strips:
      return strips_sheet(runs, picture, longest(runs));
    case PictureKind::spectra:
      return spectra_sheet(runs, picture);
    default:
      return frames_sheet(runs, picture);
  }
}

void make_picture(const StudyContents& contents, const PictureSpec& picture) {
  const fs::path stem = contents.folder / picture.name;
  if (picture.kind == PictureKind::plot)
    render::write_plot(value_plot(contents, picture), stem);
  else if (picture.kind == PictureKind::spectrum_curves)
    render::write_plot(spectrum_plot(contents, picture), stem);
  else
    render::write_png(fs::path(stem.string() + ".png"), draw_sheet(sheet_of(contents, picture)));
}

}  // namespace

std::map<std::string, std::string> make_pictures(const StudyContents& contents) {
  std::map<std::string, std::string> faults;
  for (const PictureSpec& picture : contents.study.pictures) {
    try {
      make_picture(contents, picture);
    } catch (const std::runtime_error& error) {
      faults[picture.name] = error.what();
    }
  }
  return faults;
}

}  // namespace billow::cli
