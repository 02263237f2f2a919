// A run that has ended, as its folder tells it: what is made of its frames later starts here.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/image/settings.h"

namespace billow::cli {

struct FinishedRun {
  std::filesystem::path folder;
  std::string title;            // the scene file's name without its extension
  double fps = 0.0;             // of the scene
  double simulated_time = 0.0;  // [s]
  double velocity_range = 0.0;  // [m/s] v_max of its colours
  render::VelocityColour velocity_colour = render::VelocityColour::components;  // of the velocity view
  std::optional<double> spectrum_range;         // [dB] that its spectrum's picture spans; none: it has none
  std::vector<render::View> views;              // at least one
  std::vector<std::pair<long, double>> frames;  // number and time [s] of those that it drew, ascending
};

/// Reads run.json; looks at no frame. Throws InputError when there is none, when it is damaged or of another version of
/// billow, or when the run was killed before it could say what it drew.
FinishedRun read_finished_run(const std::filesystem::path& folder);

/// "a" or "a,b": views of the run by their names; empty: the first that it has. Throws InputError with those it has.
std::vector<render::View> chosen_views(const FinishedRun& run, const std::string& names);

/// The file of a frame of the run. Throws InputError, naming it, when it is missing.
std::filesystem::path frame_file(const FinishedRun& run, render::View view, long frame);

/// "textured", or "textured_velocity" of several: how files made of these views are named.
std::string joined_names(const std::vector<render::View>& views);

/// Throws OutputError when `file` exists and must not be replaced.
void check_replaceable(const std::filesystem::path& file, bool overwrite);

}  // namespace billow::cli
