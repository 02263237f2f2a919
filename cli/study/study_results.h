// What a study's runs came to, on disk and as a table.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/study/study.h"

namespace billow::cli {

enum class RunStatus { missing, done, diverged, failed };
std::string_view name(RunStatus status);

/// One number that a run may have.
struct ResultColumn {
  std::string_view name;   // in results.csv, in `x` and `y` of a picture
  std::string_view label;  // in a legend
  std::string_view unit;
};
const std::vector<ResultColumn>& result_columns();
/// The column of that name, or null.
const ResultColumn* find_column(std::string_view name);

struct RunResult {
  RunStatus status = RunStatus::missing;
  std::string hash;                                    // of all that the result depends on
  std::string command;                                 // that repeats the run by hand
  std::string message;                                 // why it diverged or failed
  std::string scene;                                   // with every default written out
  std::vector<std::pair<std::string, double>> values;  // by column

  std::optional<double> value(std::string_view column) const;
};

/// runs/003-fb_euler-0.5 in the study's folder.
std::filesystem::path run_folder(const std::filesystem::path& folder, const Study& study, const StudyRun& run);

/// result.json of a run. Reading gives a missing result where the file is missing or damaged, or not of this `hash`.
void write_result(const std::filesystem::path& run_folder, const RunResult& result);
RunResult read_result(const std::filesystem::path& run_folder, const std::string& hash);

/// results.csv: a row for every run, its labels, status and values.
std::string results_csv(const Study& study, const std::vector<StudyRun>& runs, const std::vector<RunResult>& results);
/// study.json: the same with messages, commands and pictures.
std::string study_json(const Study& study, const std::vector<StudyRun>& runs, const std::vector<RunResult>& results);

}  // namespace billow::cli
