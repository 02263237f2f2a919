// The pictures of a study, made of its finished runs.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/study.h"
#include "cli/study_results.h"

namespace billow::cli {

/// A study with all its results, results[r] being of runs[r].
struct StudyContents {
  const Study& study;
  const std::filesystem::path& folder;
  const std::vector<StudyRun>& runs;
  const std::vector<RunResult>& results;
};

/// Writes NAME.png of every picture, and NAME.svg and NAME.csv of plots. Runs without a result leave a gap. Throws
/// OutputError, and InputError when a picture finds no run to show.
void make_pictures(const StudyContents& contents);

}  // namespace billow::cli
