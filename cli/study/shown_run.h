// The runs that a picture of a study shows, and what is on disk of each.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "cli/run/finished_run.h"
#include "cli/run/output_folder.h"
#include "cli/study/study_pictures.h"

namespace billow::cli {

struct ShownRun {
  const StudyRun* run = nullptr;
  const RunResult* result = nullptr;
  std::filesystem::path film;
  std::string label;  // by what differs among the picture's runs; empty where there is one run alone
  std::string again;  // the command that does it again
};

/// All that the picture selects, in their order, also those without a result.
std::vector<ShownRun> shown_runs(const StudyContents& contents, const PictureSpec& picture);

/// Only runs that left something to show; a diverged one, which left what came before, says so in its label.
std::vector<ShownRun> rendered_runs(const StudyContents& contents, const PictureSpec& picture);

/// The axes in which these runs differ, in the study's order.
std::vector<int> varying_axes(const Study& study, const std::vector<ShownRun>& runs);

/// "FB Euler, λ = 1": what a run is on these axes.
std::string label_on(const Study& study, const std::vector<int>& axes, const StudyRun& run);

/// "run 1 is missing, run 2 failed (exit status 4: …)", the first few of them.
std::string unfinished_runs(const std::vector<ShownRun>& runs);

/// `read`, which looks at `file` of a run's film. Where it cannot, the InputError says which run's it is, and how to
/// get it.
template <class Read>
auto of_run(const ShownRun& run, const std::filesystem::path& file, const Read& read) {
  try {
    return read(file);
  } catch (const InputError& error) {
    std::error_code ignored;
    const bool in_the_way = std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored);
    throw InputError("of run " + std::to_string(run.run->number) + ", " + error.what() + "; " +
                     (in_the_way ? "remove it, and " : "") + "do the run again with '" + run.again + "'");
  }
}

/// Throws InputError that says whether the file alone is missing, or all of the film.
void require_file(const std::filesystem::path& file);

/// The record of the run's film. Throws InputError as of_run.
FinishedRun finished_film(const ShownRun& run);

}  // namespace billow::cli
