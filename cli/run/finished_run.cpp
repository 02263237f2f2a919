// run.json -> FinishedRun.
#include "cli/run/finished_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "base/error.h"
#include "base/regular_file.h"
#include "base/suggest.h"
#include "cli/run/output_folder.h"
#include "cli/text/number_text.h"
#include "cli/yaml/yaml_tree.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

std::optional<render::View> view_named(std::string_view name) {
  for (const render::ViewRow& row : render::views())
    if (row.name == name) return row.view;
  return std::nullopt;
}

constexpr std::uintmax_t max_record_bytes = 1 << 30;  // of a million frames it has a third of that

std::string record_text(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error))
    throw InputError(fmt::format("{}: there is no such file; give the folder of a run", file.string()));
  return read_regular_file(file, max_record_bytes, "; this is no record of a run");
}

// What `key` of a section says, where the scene has both.
std::optional<std::string> scene_value(const Node& scene, std::string_view section, std::string_view key) {
  const Entry* outer = scene.find(section);
  const Entry* inner = outer ? outer->value->find(key) : nullptr;
  return inner ? std::optional(inner->value->text) : std::nullopt;
}

// What the scene, with its defaults, says about colours.
void read_colours(FinishedRun& run, const std::string& effective_scene) {
  const NodePtr scene = parse_yaml(effective_scene, "effective");
  const std::string colour = scene_value(*scene, "render", "velocity_colour").value();
  for (const Word<render::VelocityColour>& word : words(render::VelocityColour{}))
    if (word.text == colour) run.velocity_colour = word.value;
  if (const auto range = scene_value(*scene, "spectrum", "range")) run.spectrum_range = parse_number(*range).value;
}

FinishedRun run_of(const fs::path& folder, const nlohmann::json& record) {
  FinishedRun run;
  run.folder = folder;
  run.title = fs::path(record.at("scene").at("file").get<std::string>()).stem().string();
  run.fps = record.at("fps").get<double>();
  run.simulated_time = record.at("solver").at("simulated_time").get<double>();
  run.velocity_range = record.at("velocity_range").get<double>();
  read_colours(run, record.at("scene").at("effective").get<std::string>());
  for (const nlohmann::json& name : record.at("views"))
    if (const render::View view = view_named(name.get<std::string>()).value(); render::is_png(view))
      run.views.push_back(view);
  std::vector<long> drawn = record.value("drawn", std::vector<long>());  // where not all that were simulated
  for (const nlohmann::json& frame : record.at("frames"))
    if (const long number = frame.at("frame"); drawn.empty() || std::binary_search(drawn.begin(), drawn.end(), number))
      run.frames.emplace_back(number, frame.at("time").get<double>());
  return run;
}

// A run that is going on, or ended before it could list its frames.
[[noreturn]] void refuse_unfinished(const fs::path& file, const nlohmann::json& record) {
  const nlohmann::json status = record.value("status", nlohmann::json());
  const char* what = status == "running"       ? "this run has not ended; wait for it, or finish it"
                     : status == "failed"      ? "this run has failed; finish it"
                     : status == "interrupted" ? "this run was interrupted; finish it"
                                               : nullptr;
  if (!what)
    throw InputError(fmt::format(
        "{}: is damaged or of another version of billow; render the scene again with --overwrite", file.string()));
  throw InputError(fmt::format("{}: {} with 'billow render --resume'", file.string(), what));
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
  const nlohmann::json record = nlohmann::json::parse(record_text(file), nullptr, false);
  if (record.is_object() && !record.contains("frames")) refuse_unfinished(file, record);
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
