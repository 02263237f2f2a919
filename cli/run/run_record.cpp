// Writing run.json.
#include "cli/run/run_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/atomic_file.h"
#include "cli/run/incident_text.h"
#include "cli/scene/filter_text.h"
#include "cli/text/json_text.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char *running = "running", *failed = "failed", *interrupted = "interrupted";

std::string in_quotes(const std::string& word) { return '"' + word + '"'; }

std::string padded(const std::string& word, std::size_t size) { return fmt::format("{:<{}}", in_quotes(word), size); }

Json begun(const Scene& scene, const std::string& command, const char* status) {
  Json views = Json::array();
  for (const render::View view : scene.render.views) views.push_back(render::name(view));
  return {{"billow", version()},
          {"status", status},
          {"command", command},
          {"scene",
           {{"file", scene.file.string()},
            {"hash", scene.hash},
            {"timeless_hash", scene.timeless_hash},
            {"effective", scene.effective}}},
          {"fps", scene.render.fps},
          {"size", {scene.render.width, scene.render.height}},
          {"views", views}};
}

Json estimate(const sim::EigenvalueEstimate& e) {
  return {{"value", e.value}, {"iterations", e.iterations}, {"converged", e.converged}};
}

Json optional(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json watch_record(const Scene& scene, const StepChoice& choice, const FilmReport& report) {
  Json json = {{"changes_step", scene.solver.watch},
               {"largest_strain", report.facts.largest_strain},
               {"incidents", Json::array()}};
  for (const sim::Incident& incident : report.facts.incidents)
    json["incidents"].push_back({{"kind", name(incident.kind)},
                                 {"seen", incident.seen},
                                 {"from", incident.begin},
                                 {"to", incident.end},
                                 {"smallest_step", std::ldexp(choice.step, -incident.halvings)},
                                 {"discarded_steps", incident.discarded}});
  return json;
}

Json filter_record(const Run& run, const FilmReport& report) {
  const sim::Filter* filter = run.simulation.filter_operator();
  if (!filter) return {};
  Json json = {{"text", filter_text(run.scene, run.simulation)}};
  json["response"] = optional(report.filter_response);
  if (filter->options().kernel != sim::FilterKernel::levels) return json;
  json["ratio"] = filter->options().ratio;
  json["levels"] = Json::array();
  for (const sim::LevelTable& body : filter->levels())
    json["levels"].push_back(
        {{"nodes", body.nodes}, {"gamma", body.shares.gamma}, {"correction", body.shares.correction}});
  return json;
}

Json solver_record(const Run& run, const FilmReport& report) {
  const Scene& scene = run.scene;
  const StepChoice& choice = run.choice;
  Json json = {{"method", sim::name(scene.solver.method)},
               {"step", choice.step},
               {"step_from", choice.bound},
               {"limits",
                {{"paper", optional(choice.paper)},
                 {"certified", optional(choice.certified)},
                 {"any_shape", optional(choice.any_shape)}}},
               {"k0", estimate(choice.k0)}};
  if (choice.filtered) json["filtered_eigenvalue"] = estimate(*choice.filtered);
  json["filter"] = filter_record(run, report);
  json["steps"] = report.facts.steps;
  json["simulated_time"] = report.simulated_time;
  json["set_by"] = choice.setter ? Json(sim::text_of(run.simulation.structure(), *choice.setter)) : Json();
  json["watch"] = watch_record(scene, choice, report);
  json["linear_solves"] = {{"count", report.facts.solves.solves},
                           {"iterations", report.facts.solves.iterations},
                           {"tightened", report.facts.solves.tightened},
                           {"by_cholesky", report.facts.solves.by_cholesky},
                           {"not_converged", report.facts.solves.failures}};
  return json;
}

Json frame_record(const FrameRecord& f) {
  const auto list = [](const Eigen::Vector3d& v) { return Json{v.x(), v.y(), v.z()}; };
  return {{"frame", f.frame},
          {"time", f.time},
          {"kinetic_energy", f.kinetic},
          {"potential_energy", f.potential},
          {"linear_momentum", list(f.linear_momentum)},
          {"angular_momentum", list(f.angular_momentum)},
          {"largest_stretch", f.stretch.largest},
          {"mean_stretch", f.stretch.mean},
          {"touching_particles", f.touching}};
}

Json cache_records(const FilmReport& report) {
  Json json = Json::array();
  for (const CacheRecord& cache : report.caches) {
    json.push_back({{"format", word_of(cache.format)},
                    {"file", cache.file.string()},
                    {"first_frame", cache.first_frame},
                    {"frames", cache.frames}});
    if (!cache.name.empty()) json.back()["name"] = cache.name;
    if (cache.vertices) json.back()["vertices"] = *cache.vertices;
  }
  return json;
}

// The phases, which follow one another and add up to `wall`, and the stages that share "render".
Json seconds_record(const FilmReport& report, const Progress& progress) {
  Json json = Json::object();
  for (const auto& [name, seconds] : progress.phases()) json[name] = seconds;
  json.emplace("survey", 0.0);  // where the scene made it needless
  json["simulate"] = report.simulate.wall;
  json["draw"] = report.draw.wall;
  json["encode"] = report.encode.wall;
  json["wall"] = progress.wall();
  return json;
}

// The stages' own threads, and what the least wall time on these cores would have been.
Json processor_record(const Survey& survey, const FilmReport& report) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return {{"survey", survey.cost.cpu},
          {"simulate", report.simulate.cpu},
          {"draw", report.draw.cpu},
          {"encode", report.encode.cpu},
          {"total", survey.cost.cpu + report.total.cpu},
          {"cores", cores},
          {"best_wall", best_wall_seconds(survey, report, cores)}};
}

}  // namespace

Json bounds_record(const render::RunBounds& bounds) {
  const auto list = [](const Eigen::Vector3d& v) { return Json{v.x(), v.y(), v.z()}; };
  return {{"low", list(bounds.box.min())}, {"high", list(bounds.box.max())}, {"velocity_scale", bounds.velocity_scale}};
}

std::optional<render::RunBounds> recorded_bounds(const nlohmann::json& record, const Scene& scene) {
  try {
    const bool ended = record.at("status") == "done" || record.at("status") == "diverged";
    if (!ended || record.at("billow") != version() || record.at("scene").at("hash") != scene.hash) return std::nullopt;
    const nlohmann::json& bounds = record.at("bounds");
    const auto corner = [&](const char* key) {
      const nlohmann::json& list = bounds.at(key);
      return Eigen::Vector3d(list.at(0), list.at(1), list.at(2));
    };
    return render::RunBounds{{corner("low"), corner("high")}, bounds.at("velocity_scale")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

namespace {

WrittenArray array_of(const nlohmann::json& json) {
  return {json.at("file"), json.at("dtype"), json.at("shape"), json.at("axes"), json.at("unit")};
}

std::optional<CacheRecord> cache_of(const nlohmann::json& json) {
  for (const auto& [word, format] : words(CacheFormat())) {
    if (json.at("format") != word) continue;
    CacheRecord cache{format, json.value("name", ""), json.at("file").get<std::string>(), json.at("first_frame"),
                      json.at("frames")};
    if (json.contains("vertices")) cache.vertices = json["vertices"];
    return cache;
  }
  return std::nullopt;
}

}  // namespace

// A record that another version wrote, or a hand, says as much as can be read of it.
void add_made_before(const nlohmann::json& record, FilmReport& report) {
  try {
    report.strip_columns = record.at("strip_columns");
    for (const nlohmann::json& array : record.at("arrays")) report.arrays.push_back(array_of(array));
    for (const nlohmann::json& json : record.at("caches"))
      if (auto cache = cache_of(json)) report.caches.push_back(*std::move(cache));
  } catch (const nlohmann::json::exception&) {
  }
}

Json begun_record(const Run& run, const Json& bounds) {
  Json json = begun(run.scene, run.command, running);
  if (!bounds.is_null()) json["bounds"] = bounds;
  return json;
}

// The status has room behind it for the longest word, so that one can be written over another.
RunningRecord::RunningRecord(std::filesystem::path file, Json begun)
    : file_(std::move(file)), begun_(std::move(begun)) {
  const std::string room = in_quotes(interrupted);
  std::string text = json_text(begun_, 2) + "\n";
  const std::size_t place = text.find(in_quotes(running));
  text.replace(place, in_quotes(running).size(), padded(running, room.size()));
  write_file_atomically(file_, text);
  mark_.emplace(file_, static_cast<off_t>(place), padded(running, room.size()), padded(failed, room.size()), room);
}

bool RunningRecord::end(SuddenEnd how, const std::string& reason) noexcept {
  if (!mark_stands()) return false;
  try {
    begun_["status"] = how == SuddenEnd::failure ? failed : interrupted;
    if (!reason.empty()) begun_["error"] = reason;
    write_file_atomically(file_, json_text(begun_, 2) + "\n");
  } catch (const std::exception&) {  // a full disk has no room for a second file
    mark(how);
  }
  return true;
}

namespace {

// Everything but the frames.
Json finished(const Run& run, const Survey& survey, const FilmReport& report, const Progress& progress,
              const Json& differing) {
  const char* status = report.divergence ? "diverged" : report.interrupted_by ? interrupted : "done";
  Json json = begun(run.scene, run.command, status);
  if (report.divergence) json["divergence"] = *report.divergence;
  json["particles"] = run.simulation.structure().particles();
  json["springs"] = run.simulation.structure().springs();
  json["solver"] = solver_record(run, report);
  json["velocity_range"] = report.velocity_range;
  json["bounds"] = bounds_record(survey.bounds);
  json["images_written"] = report.images_written;
  json["images_kept"] = report.images_kept;
  json["strip_columns"] = report.strip_columns;
  json["arrays"] = Json::array();
  for (const WrittenArray& array : report.arrays)
    json["arrays"].push_back({{"file", array.file},
                              {"dtype", array.type},
                              {"shape", array.shape},
                              {"axes", array.axes},
                              {"unit", array.unit}});
  json["caches"] = cache_records(report);
  for (const auto& [key, value] : differing.items()) json[key] = value;
  json["seconds"] = seconds_record(report, progress);
  json["processor_seconds"] = processor_record(survey, report);
  json["resident_kib"] = {{"after_100_frames", report.memory.settled}, {"end", report.memory.end}};
  json["backend"] = report.backend;
  json["gl"] = report.gl;
  return json;
}

}  // namespace

// The frames go through memory one by one, so that a film's length does not show there.
void write_finished_record(const std::filesystem::path& file, const Run& run, const Survey& survey,
                           const FilmReport& report, const Progress& progress,
                           const nlohmann::ordered_json& differing) {
  AtomicFile output(file);
  const std::string head = json_text(finished(run, survey, report, progress, differing), 1);
  output.append(std::string_view(head).substr(0, head.size() - 2));  // without "\n}"
  output.append(",\n \"frames\": [");
  const char* separator = "\n  ";
  for (const FrameRecord& frame : report.frames) {
    output.append(separator + json_text(frame_record(frame)));
    separator = ",\n  ";
  }
  output.append("\n ]\n}\n");
  output.commit();
}

}  // namespace billow::cli
