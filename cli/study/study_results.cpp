// result.json, results.csv, study.json.
#include "cli/study/study_results.h"

#include <fmt/format.h>

#include <sys/stat.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/atomic_file.h"
#include "base/csv.h"
#include "base/error.h"
#include "base/regular_file.h"
#include "cli/text/json_text.h"
#include "cli/text/number_text.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* result_name = "result.json";
constexpr std::uintmax_t max_result_bytes = 64 << 20;

// "backward Euler, 0.01 s" -> "backward-Euler-0.01-s"
std::string slug(const std::string& label) {
  std::string out;
  for (const char c : label) {
    const bool kept = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_';
    if (kept) out += c;
    if (!kept && !out.empty() && out.back() != '-') out += '-';
  }
  while (!out.empty() && (out.back() == '-' || out.back() == '.')) out.pop_back();
  return out.substr(0, 60);
}

RunStatus status_named(const std::string& word) {
  for (const RunStatus status : {RunStatus::done, RunStatus::diverged, RunStatus::failed})
    if (word == name(status)) return status;
  throw InputError("unknown status");
}

// The file's text; nothing where there is none, also when another process has just removed it.
std::optional<std::string> result_text(const fs::path& file) {
  std::error_code error;
  try {
    if (!fs::exists(file, error)) return std::nullopt;
    return read_regular_file(file, max_result_bytes, "; this is no result");
  } catch (const InputError& fault) {
    if (!fs::exists(file, error)) return std::nullopt;
    throw InputError(fmt::format("{}; move it away or remove it, and the run is done again", fault.what()));
  }
}

RunResult parsed(const Json& json) {
  RunResult result;
  result.status = status_named(json.at("status").get<std::string>());
  result.hash = json.at("hash").get<std::string>();
  result.command = json.at("command").get<std::string>();
  result.message = json.at("message").get<std::string>();
  result.scene = json.at("scene").get<std::string>();
  for (const auto& [column, value] : json.at("values").items()) result.values.emplace_back(column, value.get<double>());
  return result;
}

Json values_of(const RunResult& result) {
  Json values = Json::object();
  for (const auto& [column, value] : result.values) values[column] = value;
  return values;
}

Json run_json(const Study& study, const StudyRun& run, const RunResult& result) {
  Json settings = Json::object();
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    settings[study.axes[a].name] = study.axes[a].values[run.choice[a]].label;
  return {{"run", run.number},
          {"settings", settings},
          {"status", name(result.status)},
          {"message", result.message},
          {"values", values_of(result)},
          {"command", result.command},
          {"folder", run_folder("", study, run).string()},
          {"hash", result.hash}};
}

}  // namespace

std::string_view name(RunStatus status) {
  switch (status) {
    case RunStatus::done:
      return "done";
    case RunStatus::diverged:
      return "diverged";
    case RunStatus::failed:
      return "failed";
    case RunStatus::missing:
      break;
  }
  return "missing";
}

const std::vector<ResultColumn>& result_columns() {
  constexpr std::string_view step = "largest stable step", ratio = "step", multiple = "× unfiltered limit";
  static const std::vector<ResultColumn> columns = {
      {"duration", "duration of the scene", "s", {}, ColumnGroup::scene},
      {"particles", "particles", "", {}, ColumnGroup::scene},
      {"springs", "springs", "", {}, ColumnGroup::scene},
      {"k0", "largest eigenvalue k0", "1/s²", {}, ColumnGroup::scene},
      {"unfiltered", "unfiltered limit (equation 11)", "s", step, ColumnGroup::steps},
      {"paper", "the paper's criterion", "s", step, ColumnGroup::steps},
      {"certified", "certified at rest", "s", step, ColumnGroup::steps},
      {"any_shape", "certified for any shape", "s", step, ColumnGroup::steps},
      {"measured", "measured", "s", step, ColumnGroup::steps},
      {"step", "step taken", "s", "step", ColumnGroup::steps},
      {"paper_ratio", "the paper's criterion", multiple, ratio, ColumnGroup::ratios},
      {"certified_ratio", "certified at rest", multiple, ratio, ColumnGroup::ratios},
      {"any_shape_ratio", "certified for any shape", multiple, ratio, ColumnGroup::ratios},
      {"measured_ratio", "measured", multiple, ratio, ColumnGroup::ratios},
      {"step_ratio", "step taken", multiple, ratio, ColumnGroup::ratios},
      {"steps", "steps", "", {}, ColumnGroup::cost},
      {"seconds", "computing time", "s", "time", ColumnGroup::cost},
      {"cpu_seconds", "processor time", "s", "time", ColumnGroup::cost},
      {"iterations_per_solve", "iterations per linear solve", "", {}, ColumnGroup::cost},
      {"error", "position error", "m", "position error", ColumnGroup::error},
      {"error_worst", "largest position error of a moment", "m", "position error", ColumnGroup::error},
      {"energy", "energy at the end", "J", "energy at the end", ColumnGroup::error},
      {"reference_energy", "the reference's energy", "J", "energy at the end", ColumnGroup::error},
  };
  return columns;
}

const ResultColumn* find_column(std::string_view name) {
  for (const ResultColumn& column : result_columns())
    if (column.name == name) return &column;
  return nullptr;
}

std::optional<double> RunResult::value(std::string_view column) const {
  for (const auto& [name, value] : values)
    if (name == column) return value;
  return std::nullopt;
}

fs::path run_folder(const fs::path& folder, const Study& study, const StudyRun& run) {
  const std::string label = run.choice.empty() ? "" : "-" + slug(label_of(study, run));
  return folder / "runs" / fmt::format("{:03}{}", run.number, label);
}

void write_result(const fs::path& run_folder, const RunResult& result) {
  const Json json = {{"status", name(result.status)}, {"hash", result.hash},   {"message", result.message},
                     {"command", result.command},     {"scene", result.scene}, {"values", values_of(result)}};
  write_file_atomically(run_folder / result_name, json_text(json, 1) + "\n");
}

RunResult read_result(const fs::path& run_folder, const std::string& hash) {
  const std::optional<std::string> text = result_text(run_folder / result_name);
  if (!text) return {};
  RunResult damaged;
  damaged.message = "its result.json is damaged and counts as none";
  try {
    RunResult result = parsed(Json::parse(*text));
    return result.hash == hash ? result : RunResult();
  } catch (const Json::exception&) {
    return damaged;
  } catch (const InputError&) {
    return damaged;
  }
}

ResultStamp result_stamp(const fs::path& run_folder) {
  struct stat status = {};
  if (stat((run_folder / result_name).c_str(), &status) != 0) return {};
  return {status.st_ino, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

void remove_result(const fs::path& run_folder) {
  std::error_code error;
  fs::remove(run_folder / result_name, error);
  if (error)
    throw OutputError(fmt::format("cannot replace {}: {}", (run_folder / result_name).string(), error.message()));
}

std::string results_csv(const Study& study, const std::vector<StudyRun>& runs, const std::vector<RunResult>& results) {
  std::string out = "run";
  for (const Axis& axis : study.axes) out += "," + csv_field(axis.name);
  out += ",status";
  for (const ResultColumn& column : result_columns()) out += fmt::format(",{}", column.name);
  out += "\n";
  for (std::size_t r = 0; r < runs.size(); ++r) {
    out += std::to_string(runs[r].number);
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      out += "," + csv_field(study.axes[a].values[runs[r].choice[a]].label);
    out += fmt::format(",{}", name(results[r].status));
    for (const ResultColumn& column : result_columns()) {
      const std::optional<double> value = results[r].value(column.name);
      out += "," + (value ? shortest(*value) : "");
    }
    out += "\n";
  }
  return out;
}

std::string study_json(const Study& study, const std::vector<StudyRun>& runs, const std::vector<RunResult>& results) {
  Json json = {{"billow", version()},           {"title", study.title},  {"study", study.file.string()},
               {"scene", study.scene.string()}, {"runs", Json::array()}, {"pictures", Json::array()}};
  for (std::size_t r = 0; r < runs.size(); ++r) json["runs"].push_back(run_json(study, runs[r], results[r]));
  for (const PictureSpec& picture : study.pictures)
    json["pictures"].push_back({{"name", picture.name}, {"title", picture.title}, {"file", picture.name + ".png"}});
  return json_text(json, 1) + "\n";
}

}  // namespace billow::cli
