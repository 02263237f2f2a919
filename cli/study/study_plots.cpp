// Results and spectra -> curves over the axes of the study.
#include "cli/study/study_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "base/regular_file.h"
#include "cli/scene/scene_parts.h"
#include "cli/study/shown_run.h"
#include "cli/text/number_text.h"
#include "cli/text/text_file.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_table_bytes = 64 << 20;

std::string with_unit(std::string_view label, std::string_view unit) {
  return std::string(label) + (unit.empty() ? "" : fmt::format(" [{}]", unit));
}

const Axis* axis_named(const Study& study, const std::string& name) {
  for (const Axis& axis : study.axes)
    if (axis.name == name) return &axis;
  return nullptr;
}

std::string column_label(const Study& study, const std::string& name) {
  if (const ResultColumn* column = find_column(name)) return with_unit(column->label, column->unit);
  const Axis* axis = axis_named(study, name);
  return axis ? axis->label : name;
}

// What several columns can share an axis under: "largest stable step [s]".
std::string quantity_label(const Study& study, const std::string& name) {
  const ResultColumn* column = find_column(name);
  if (!column || column->quantity.empty()) return column_label(study, name);
  return with_unit(column->quantity, column->unit);
}

std::string unit_of_column(const std::string& name) {
  const ResultColumn* column = find_column(name);
  return column ? std::string(column->unit) : "";
}

bool share_a_scale(const std::vector<std::string>& columns) {
  return std::all_of(columns.begin(), columns.end(),
                     [&](const std::string& name) { return unit_of_column(name) == unit_of_column(columns.front()); });
}

// Of one column all that is known; of several what they are values of, each once.
std::string y_label(const Study& study, const std::vector<std::string>& columns) {
  if (columns.size() == 1) {
    const std::string quantity = quantity_label(study, columns.front()), label = column_label(study, columns.front());
    const ResultColumn* column = find_column(columns.front());
    const bool says_it = !column || column->label.starts_with(column->quantity);
    return says_it ? label : fmt::format("{}, {}", quantity, column->label);
  }
  std::vector<std::string> quantities;
  for (const std::string& name : columns)
    if (const std::string label = quantity_label(study, name);
        std::find(quantities.begin(), quantities.end(), label) == quantities.end())
      quantities.push_back(label);
  return fmt::format("{}", fmt::join(quantities, ", "));
}

/// The curves of a plot: one for every combination of curve names on the picture's axes, and of columns.
class CurveSet {
 public:
  CurveSet(const Study& study, const PictureSpec& picture, const std::vector<ShownRun>& runs)
      : study_(study), picture_(picture) {
    for (const int axis : picture.by) {
      std::vector<std::string> names;
      for (const ShownRun& shown : runs)
        if (const std::string& name = name_on(axis, *shown.run);
            std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
      dimensions_.push_back({in_axis_order(axis, names)});
    }
    if (picture.y.size() < 2) return;
    render::Dimension columns{{}, !share_a_scale(picture.y)};
    for (const std::string& name : picture.y) columns.values.push_back(column_name(name, columns.own_scale));
    dimensions_.push_back(std::move(columns));
  }

  void add(const StudyRun& run, std::size_t column, double x, double y) {
    std::vector<int> at;
    for (std::size_t d = 0; d < picture_.by.size(); ++d) {
      const std::vector<std::string>& values = dimensions_[d].values;
      at.push_back(
          static_cast<int>(std::find(values.begin(), values.end(), name_on(picture_.by[d], run)) - values.begin()));
    }
    if (picture_.y.size() > 1) at.push_back(static_cast<int>(column));
    points_[at].emplace_back(x, y);
  }

  const std::vector<render::Dimension>& dimensions() const { return dimensions_; }

  // Points by ascending x, whatever the order of the runs.
  std::vector<render::Curve> curves(const std::string& name_of_the_only) {
    std::vector<render::Curve> curves;
    for (auto& [at, points] : points_) {
      std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      std::vector<std::string_view> names;
      for (std::size_t d = 0; d < at.size(); ++d) names.push_back(dimensions_[d].values[at[d]]);
      curves.push_back({names.empty() ? name_of_the_only : fmt::format("{}", fmt::join(names, ", ")), {}, {}, at});
      for (const auto& [x, y] : points) {
        curves.back().x.push_back(x);
        curves.back().y.push_back(y);
      }
    }
    return curves;
  }

 private:
  const std::string& name_on(int axis, const StudyRun& run) const {
    return study_.axes[axis].values[run.choice[axis]].curve;
  }

  std::vector<std::string> in_axis_order(int axis, const std::vector<std::string>& names) const {
    std::vector<std::string> ordered;
    for (const AxisValue& value : study_.axes[axis].values)
      if (std::find(names.begin(), names.end(), value.curve) != names.end() &&
          std::find(ordered.begin(), ordered.end(), value.curve) == ordered.end())
        ordered.push_back(value.curve);
    return ordered;
  }

  std::string column_name(const std::string& name, bool with_its_unit) const {
    const ResultColumn* column = find_column(name);
    return with_its_unit || !column ? column_label(study_, name) : std::string(column->label);
  }

  const Study& study_;
  const PictureSpec& picture_;
  std::vector<render::Dimension> dimensions_;
  std::map<std::vector<int>, std::vector<std::pair<double, double>>> points_;
};

// An axis whose values are not all numbers has them side by side.
bool counts_names(const Axis* axis) {
  return axis && !std::all_of(axis->values.begin(), axis->values.end(), [](const AxisValue& value) {
           return parse_number(value.label).fault == NumberFault::none;
         });
}

// What stands along such an axis: the values of the runs shown.
std::vector<int> named_values(const Study& study, const Axis& axis, const std::vector<ShownRun>& runs) {
  const auto a = static_cast<std::size_t>(&axis - study.axes.data());
  std::set<int> values;
  for (const ShownRun& shown : runs) values.insert(shown.run->choice[a]);
  return {values.begin(), values.end()};
}

/// Where a run stands along x.
class AlongX {
 public:
  AlongX(const Study& study, const PictureSpec& picture, const std::vector<ShownRun>& runs)
      : study_(study), column_(picture.x), axis_(find_column(picture.x) ? nullptr : axis_named(study, picture.x)) {
    if (counts_names(axis_)) values_ = named_values(study, *axis_, runs);
  }

  std::optional<double> of(const ShownRun& shown) const {
    if (!axis_) return shown.result->value(column_);
    const int value = shown.run->choice[static_cast<std::size_t>(axis_ - study_.axes.data())];
    if (values_.empty()) return parse_number(axis_->values[value].label).value;
    return static_cast<double>(std::find(values_.begin(), values_.end(), value) - values_.begin());
  }

  // The axis's own name stands below them.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const int value : values_) names.push_back(axis_->values[value].label);
    return names;
  }

 private:
  const Study& study_;
  std::string column_;
  const Axis* axis_;
  std::vector<int> values_;  // of an axis that is no numbers
};

// A column's value, or the number that an axis gives.
std::optional<double> value_in(const Study& study, const ShownRun& shown, const std::string& column) {
  if (find_column(column)) return shown.result->value(column);
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (study.axes[a].name == column) {
      const ParsedNumber number = parse_number(study.axes[a].values[shown.run->choice[a]].label);
      if (number.fault == NumberFault::none) return number.value;
    }
  return std::nullopt;
}

// "FB Euler and RK4 diverged", "h = 0.1 s; h = 0.2 s; h = 0.3 s and 4 more are missing"
std::string said_of(const std::vector<std::string>& which, const std::string& one, const std::string& several) {
  constexpr std::size_t most_named = 3;
  if (which.size() <= most_named)
    return fmt::format("{} {}", fmt::join(which, " and "), which.size() > 1 ? several : one);
  return fmt::format("{} and {} more {}", fmt::join(which.begin(), which.begin() + most_named, "; "),
                     which.size() - most_named, several);
}

std::vector<std::string> labels_where(const std::vector<ShownRun>& runs, const auto& holds) {
  std::vector<std::string> labels;
  for (const ShownRun& run : runs)
    if (holds(run)) labels.push_back(run.label.empty() ? "the run" : run.label);
  return labels;
}

// "Not shown: FB Euler, λ = 1 diverged; 7 runs are missing."
std::string left_out(const std::vector<ShownRun>& runs, const std::vector<std::string>& columns) {
  std::vector<std::string> parts;
  const auto add = [&](const std::vector<std::string>& which, const std::string& one, const std::string& several) {
    if (!which.empty()) parts.push_back(said_of(which, one, several));
  };
  const auto add_status = [&](RunStatus status, const std::string& one, const std::string& several) {
    add(labels_where(runs, [&](const ShownRun& run) { return run.result->status == status; }), one, several);
  };
  add_status(RunStatus::diverged, "diverged", "diverged");
  add_status(RunStatus::failed, "failed", "failed");
  add_status(RunStatus::missing, "is missing", "are missing");
  for (const std::string& column : columns)
    add(labels_where(
            runs,
            [&](const ShownRun& run) { return run.result->status == RunStatus::done && !run.result->value(column); }),
        "has no " + column, "have no " + column);
  return parts.empty() ? "" : fmt::format("Not shown: {}.", fmt::join(parts, "; "));
}

std::string joined(const std::string& note, const std::string& more) {
  if (note.empty() || more.empty()) return note + more;
  return note + (std::string_view(".!?").find(note.back()) == std::string_view::npos ? ". " : " ") + more;
}

// The columns of the results that a plot is of; the rest of what it names are axes.
std::vector<std::string> result_columns_of(const PictureSpec& picture) {
  std::vector<std::string> columns = picture.y;
  if (std::find(columns.begin(), columns.end(), picture.x) == columns.end()) columns.push_back(picture.x);
  std::erase_if(columns, [](const std::string& name) { return !find_column(name); });
  return columns;
}

// Says why, where there is nothing to plot at all.
void require_points(const std::vector<render::Curve>& curves, const std::string& why) {
  for (const render::Curve& curve : curves)
    if (std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); })) return;
  throw InputError(why.empty() ? "there is no point to plot" : "there is no point to plot. " + why);
}

// A diverged run took no step to its end, so its times and limits would mislead.
render::Plot value_plot(const StudyContents& contents, const PictureSpec& picture) {
  const Study& study = contents.study;
  const std::vector<ShownRun> runs = shown_runs(contents, picture);
  CurveSet set(study, picture, runs);
  const AlongX along_x(study, picture, runs);
  for (std::size_t column = 0; column < picture.y.size(); ++column)
    for (const ShownRun& shown : runs) {
      const bool done = shown.result->status == RunStatus::done;
      const std::optional<double> x = along_x.of(shown);
      const std::optional<double> y = done ? value_in(study, shown, picture.y[column]) : std::nullopt;
      if (x) set.add(*shown.run, column, *x, y.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
  const std::string missing = left_out(runs, result_columns_of(picture));
  std::vector<render::Curve> curves = set.curves(column_label(study, picture.y.front()));
  require_points(curves, missing);
  const bool one_scale = share_a_scale(picture.y);
  return {.title = picture.title,
          .x_label = picture.x_label.empty() ? column_label(study, picture.x) : picture.x_label,
          .y_label = !picture.y_label.empty() ? picture.y_label
                     : one_scale              ? y_label(study, picture.y)
                                              : "",
          .log_x = picture.log_x && along_x.names().empty(),
          .log_y = picture.log_y,
          .points = true,
          .curves = std::move(curves),
          .dimensions = set.dimensions(),
          .note = joined(picture.note, missing),
          .x_names = along_x.names()};
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
std::vector<std::pair<double, double>> spectrum_of_run(const ShownRun& run) {
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

// What came before a divergence is no run's spectrum.
render::Plot spectrum_plot(const StudyContents& contents, const PictureSpec& picture) {
  const std::vector<ShownRun> all = shown_runs(contents, picture);
  std::vector<ShownRun> runs = all;
  std::erase_if(runs, [](const ShownRun& run) { return run.result->status != RunStatus::done; });
  CurveSet set(contents.study, picture, runs);
  for (const ShownRun& run : runs)
    for (const auto& [frequency, power] : spectrum_of_run(run)) set.add(*run.run, 0, frequency, power);
  const std::string missing = left_out(all, {});
  std::vector<render::Curve> curves = set.curves("the scene");
  require_points(curves, missing);
  return {.title = picture.title,
          .x_label = picture.x_label.empty() ? "radial frequency [cycles per side]" : picture.x_label,
          .y_label = picture.y_label.empty() ? "mean square velocity [m²/s²]" : picture.y_label,
          .log_x = picture.log_x,
          .log_y = picture.log_y,
          .points = false,
          .curves = std::move(curves),
          .dimensions = set.dimensions(),
          .note = joined(picture.note, missing),
          .x_names = {}};
}

// Runs that differ on an axis that no curve tells would make one curve of several values at every x. Where x is a
// column, such an axis may be what x varies with.
PictureSpec with_all_curves(const StudyContents& contents, PictureSpec picture) {
  const Study& study = contents.study;
  if (picture.kind == PictureKind::plot && find_column(picture.x)) return picture;
  for (const int axis : varying_axes(study, shown_runs(contents, picture)))
    if (study.axes[axis].name != picture.x && std::find(picture.by.begin(), picture.by.end(), axis) == picture.by.end())
      picture.by.push_back(axis);
  return picture;
}

}  // namespace

render::Plot plot_of(const StudyContents& contents, const PictureSpec& picture) {
  const PictureSpec whole = with_all_curves(contents, picture);
  return whole.kind == PictureKind::plot ? value_plot(contents, whole) : spectrum_plot(contents, whole);
}

}  // namespace billow::cli
