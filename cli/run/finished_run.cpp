// run.json -> FinishedRun.
#include "cli/run/finished_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "base/error.h"
#include "base/suggest.h"
#include "cli/run/output_folder.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::optional<render::View> view_named(std::string_view name) {
  for (const render::ViewRow& row : render::views())
    if (row.name == name) return row.view;
  return std::nullopt;
}

std::string record_text(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(fmt::format("{}: this is not a regular file; give the folder of a run", file.string()));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(fmt::format("{}: there is no such file; give the folder of a run", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

FinishedRun run_of(const fs::path& folder, const Json& record) {
  FinishedRun run;
  run.folder = folder;
  run.title = fs::path(record.at("scene").at("file").get<std::string>()).stem().string();
  run.fps = record.at("fps").get<double>();
  run.simulated_time = record.at("solver").at("simulated_time").get<double>();
  for (const Json& name : record.at("views"))
    if (const render::View view = view_named(name.get<std::string>()).value(); render::is_png(view))
      run.views.push_back(view);
  std::vector<long> drawn = record.value("drawn", std::vector<long>());  // where not all that were simulated
  for (const Json& frame : record.at("frames"))
    if (const long number = frame.at("frame"); drawn.empty() || std::binary_search(drawn.begin(), drawn.end(), number))
      run.frames.emplace_back(number, frame.at("time").get<double>());
  return run;
}

render::View view_of_run(const FinishedRun& run, std::string_view name) {
  std::vector<std::string_view> known;
  for (const render::View view : run.views) {
    if (render::name(view) == name) return view;
    known.push_back(render::name(view));
  }
  throw InputError(fmt::format("--view: {} has no view '{}'{}", run.folder.string(), name,
                               suggestion(name, known, "its views are")));
}

}  // namespace

FinishedRun read_finished_run(const fs::path& folder) {
  const fs::path file = folder / word_of(RunFile::record);
  const Json record = Json::parse(record_text(file), nullptr, false);
  if (record.is_object() && record.value("status", Json()) == "running")
    throw InputError(fmt::format("{}: this run has not ended; wait for it, or finish it with 'billow render --resume'",
                                 file.string()));
  FinishedRun run;
  try {
    run = run_of(folder, record);
  } catch (const std::exception&) {
    throw InputError(fmt::format(
        "{}: is damaged or of another version of billow; render the scene again with --overwrite", file.string()));
  }
  if (run.views.empty())
    throw InputError(fmt::format(
        "{}: this run has no pictures as PNG; draw some, of states with 'billow render --from'", file.string()));
  return run;
}

std::vector<render::View> chosen_views(const FinishedRun& run, const std::string& names) {
  if (names.empty()) return {run.views.front()};
  std::vector<render::View> chosen;
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find(',', begin), names.size());
    chosen.push_back(view_of_run(run, std::string_view(names).substr(begin, end - begin)));
    begin = end + 1;
  }
  return chosen;
}

fs::path frame_file(const FinishedRun& run, render::View view, long frame) {
  const fs::path file = frame_of(run.folder, view, frame);
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    throw InputError(fmt::format("{}: this frame of the run is missing; draw it again with 'billow render --resume'",
                                 file.string()));
  return file;
}

std::string joined_names(const std::vector<render::View>& views) {
  std::vector<std::string_view> names;
  for (const render::View view : views) names.push_back(render::name(view));
  return fmt::format("{}", fmt::join(names, "_"));
}

void check_replaceable(const fs::path& file, bool overwrite) {
  std::error_code error;
  if (!overwrite && fs::exists(file, error))
    throw OutputError(
        fmt::format("{} already exists; use --overwrite to replace it, or -o for another", file.string()));
}

}  // namespace billow::cli
