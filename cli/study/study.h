// A validated study: a base scene, axes of variation, what to measure, and what to make of the runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/words.h"
#include "cli/yaml/yaml_overrides.h"

namespace billow::cli {

/// One value of an axis: how tables and legends call it, and what it changes in the base scene.
struct AxisValue {
  std::string label;  // in results and names of folders
  std::string shown;  // in pictures: "λ = 1"
  std::string curve;  // that plots draw it on; as shown, unless several values share one
  std::vector<Override> changes;
};

struct Axis {
  std::string name;               // in results
  std::string label;              // in pictures and on the page, with its unit: "λ"
  std::vector<AxisValue> values;  // at least one
};

/// What a run's motion is compared with: the same run with these changes, so many seconds long.
struct ReferenceSpec {
  double until = 0.0;  // [s] 0: nothing is compared
  std::vector<Override> changes;
  std::string where;  // in the study file, of the changes
};

/// What every run does.
struct Measures {
  bool render = true;     // what `billow render` writes: frames, strip, spectrum, page
  bool measured = false;  // bisect for the largest step at which the whole run behaves
  int repeats = 0;        // times to run without rendering, by the clock; 0: none
  ReferenceSpec error;    // how far its positions are from a reference's
};

/// Which runs a picture shows: for the named axes, the indices of the values it takes.
struct Selection {
  int axis = 0;
  std::vector<int> values;
};

enum class PictureKind { strips, spectra, frames, plot, spectrum_curves };
Words<PictureKind> words(PictureKind);

/// One picture made of the finished runs.
struct PictureSpec {
  PictureKind kind = PictureKind::plot;
  std::string name;   // of its files
  std::string place;  // in the study file
  std::string title, note;
  std::vector<Selection> where;
  std::optional<int> rows;               // axis: one strip, one column of spectra, or one row of frames per value
  std::vector<double> times;             // [s] of the frames shown
  std::vector<std::string> times_where;  // in the study file, of each
  std::vector<std::string> views;        // of frames
  std::string x;                         // column of the results
  std::vector<std::string> y;            // columns; several make several curves
  std::vector<int> by;                   // axes: a curve for every combination of their values
  std::string x_label, y_label;
  bool log_x = false, log_y = false;
};

/// Draws curves: its picture is an SVG file too, and its numbers a table.
bool is_plot(const PictureSpec& picture);
/// The names of the files of a picture.
std::vector<std::string> files_of(const PictureSpec& picture);

/// The names of the files that a study makes of all its runs, besides its pictures.
namespace study_files {
inline constexpr std::string_view table = "results.csv", record = "study.json", page = "index.html";
}

struct Study {
  std::filesystem::path file, scene;
  std::string title, about;
  std::vector<Override> base;  // `set`: for every run, before what the axes change
  std::vector<Axis> axes;
  Measures measures;
  std::vector<PictureSpec> pictures;
};

/// One combination of the axes' values. Runs are numbered from 1, the last axis varying fastest.
struct StudyRun {
  int number = 0;
  std::vector<int> choice;  // per axis, the index of its value
};

/// Reads and checks a study file; the scenes of its runs are checked when they are read.
/// Throws InputError "FILE:LINE:COLUMN: …".
Study read_study(const std::filesystem::path& file);

std::vector<StudyRun> runs_of(const Study& study);
/// What a run changes in the base scene, in order.
std::vector<Override> overrides_of(const Study& study, const StudyRun& run);
/// "fb_euler, λ = 1": the labels of the run's values.
std::string label_of(const Study& study, const StudyRun& run);
/// True when the run is among those that a picture shows.
bool selects(const PictureSpec& picture, const StudyRun& run);
/// Whether the picture shows `a` above `b`; runs of which neither comes first stay in their order.
bool comes_first(const PictureSpec& picture, const StudyRun& a, const StudyRun& b);

}  // namespace billow::cli
