// The pictures of a study, made of its finished runs.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/study/study.h"
#include "cli/study/study_results.h"

namespace billow::cli {

/// A study with all its results, results[r] being of runs[r].
struct StudyContents {
  const Study& study;
  const std::filesystem::path& folder;
  const std::vector<StudyRun>& runs;
  const std::vector<RunResult>& results;
  std::map<std::string, std::string> faults;  // pictures that could not be made, and why
};

/// Writes NAME.png of every picture, and NAME.svg and NAME.csv of plots. Runs without a result leave a gap. A picture
/// that cannot be made stops no other: returns the names of those, and why.
std::map<std::string, std::string> make_pictures(const StudyContents& contents);

}  // namespace billow::cli
