// What a study's runs came to, on disk and as a table.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/study/study.h"

namespace billow::cli {

enum class RunStatus { missing, done, diverged, failed };
std::string_view name(RunStatus status);

/// What numbers of a run tell about.
enum class ColumnGroup { scene, steps, ratios, cost, error };

/// One number that a run may have.
struct ResultColumn {
  std::string_view name;   // in results.csv, in `x` and `y` of a picture
  std::string_view label;  // in a legend
  std::string_view unit;
  std::string_view quantity;  // that several columns are values of; empty: the label says it
  ColumnGroup group;
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

/// result.json of a run. Reading gives a missing result where there is no file, or one that is not of this `hash` or
/// damaged; a damaged one leaves a message. Throws InputError where something that is no file is in its place, or a
/// file that cannot be read.
void write_result(const std::filesystem::path& run_folder, const RunResult& result);
RunResult read_result(const std::filesystem::path& run_folder, const std::string& hash);
/// Removes it, if it is there. Throws OutputError.
void remove_result(const std::filesystem::path& run_folder);

/// Tells a result from the one that another process writes in its place, also when both say the same. All zero: none.
struct ResultStamp {
  std::uint64_t file = 0;
  std::int64_t seconds = 0, nanoseconds = 0;
  bool operator==(const ResultStamp&) const = default;
};
ResultStamp result_stamp(const std::filesystem::path& run_folder);

/// results.csv: a row for every run, its labels, status and values.
std::string results_csv(const Study& study, const std::vector<StudyRun>& runs, const std::vector<RunResult>& results);
/// study.json: the same with messages, commands and pictures.
std::string study_json(const Study& study, const std::vector<StudyRun>& runs, const std::vector<RunResult>& results);

}  // namespace billow::cli
