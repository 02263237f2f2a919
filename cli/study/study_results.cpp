// result.json, results.csv, study.json.
#include "cli/study/study_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "cli/text/json_text.h"
#include "cli/text/number_text.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

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
  return RunStatus::missing;
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

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
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
  static const std::vector<ResultColumn> columns = {
      {"duration", "duration of the scene", "s"},
      {"particles", "particles", ""},
      {"springs", "springs", ""},
      {"k0", "largest eigenvalue k0", "1/s²"},
      {"unfiltered", "unfiltered limit (equation 11)", "s"},
      {"paper", "the paper's criterion", "s"},
      {"certified", "certified at rest", "s"},
      {"any_shape", "certified for any shape", "s"},
      {"measured", "measured", "s"},
      {"step", "step taken", "s"},
      {"paper_ratio", "the paper's criterion", ""},
      {"certified_ratio", "certified at rest", ""},
      {"any_shape_ratio", "certified for any shape", ""},
      {"measured_ratio", "measured", ""},
      {"step_ratio", "step taken", ""},
      {"steps", "steps", ""},
      {"seconds", "computing time", "s"},
      {"cpu_seconds", "processor time", "s"},
      {"iterations_per_solve", "iterations per linear solve", ""},
      {"error", "position error", "m"},
      {"error_worst", "largest position error of a moment", "m"},
      {"energy", "energy at the end", "J"},
      {"reference_energy", "the reference's energy", "J"},
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
  write_file_atomically(run_folder / "result.json", json_text(json, 1) + "\n");
}

RunResult read_result(const fs::path& run_folder, const std::string& hash) {
  std::error_code error;
  if (!fs::is_regular_file(run_folder / "result.json", error)) return {};
  std::ifstream file(run_folder / "result.json");
  try {
    RunResult result = parsed(Json::parse(file));
    if (result.hash == hash) return result;
  } catch (const Json::exception&) {
    // a damaged record is no record
  }
  return {};
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
