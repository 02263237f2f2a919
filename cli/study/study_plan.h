// A study on its way: its runs, and where they and their results are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/study/study.h"
#include "cli/study/study_results.h"
#include "render/gl/backend.h"

namespace billow::cli {

/// What pictures can be made of a run, as its scene has it.
struct RunOffer {
  double duration = 0.0;  // [s]
  bool strip = false, spectrum = false;
  std::vector<std::string> views;
};

/// Runs are told by their numbers, from 1.
struct StudyPlan {
  Study study;
  std::filesystem::path folder;
  std::vector<StudyRun> runs;
  std::vector<std::string> hash;               // per run, what its result must carry to count; see read_hash()
  std::vector<std::optional<RunOffer>> offer;  // per run, where it has been read
  bool untrusted = false;                      // no file outside of the study's folder is read
  render::Backend backend = {};                // that draws its runs
  int threads = 0;                             // of a run; 0: one per core
  bool resume = false;  // runs keep their states while they go on, for those that follow one that was stopped

  const StudyRun& run(int number) const { return runs[static_cast<std::size_t>(number) - 1]; }
  std::filesystem::path folder_of(int number) const { return run_folder(folder, study, run(number)); }
  std::filesystem::path log_of(int number) const { return folder_of(number) / "log.txt"; }
  std::filesystem::path claim_of(int number) const { return folder_of(number) / "claim"; }
  /// "run 3, fb_euler, 0.5"
  std::string name_of(int number) const;
  /// Throws InputError as read_result.
  RunResult result_of(int number) const;
};

/// out/ and the study's name.
std::filesystem::path usual_folder(const std::filesystem::path& study);

/// `folder` may be empty: the usual one. Throws InputError as read_study.
StudyPlan make_plan(const std::filesystem::path& study, const std::filesystem::path& folder);

/// Reads a run's scene, which its hash and offer are of. Throws InputError where the scene is at fault.
void read_hash(StudyPlan& plan, int number);

/// Throws InputError where a picture wants what the scene of one of its runs that have been read does not make, or a
/// moment after the end of each of its runs, all of which have been read.
void check_pictures(const StudyPlan& plan);

/// Results count as they stand here; a run that failed or was not done does not.
bool is_finished(const RunResult& result);

}  // namespace billow::cli
