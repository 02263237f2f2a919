// States and checkpoints as NPZ files.
#include "cli/run/state_store.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/npz.h"
#include "cli/run/schedule.h"
#include "cli/text/json_text.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view extension = ".npz";

// What of an incident is kept in the columns of a checkpoint's matrix.
constexpr int incident_columns = 6;

Eigen::MatrixXd matrix_of(const std::vector<sim::Incident>& incidents) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(incidents.size()), incident_columns);
  for (std::size_t k = 0; k < incidents.size(); ++k) {
    const sim::Incident& i = incidents[k];
    rows.row(static_cast<Eigen::Index>(k)) << static_cast<double>(i.kind), i.begin, i.end, i.seen, i.halvings,
        static_cast<double>(i.discarded);
  }
  return rows;
}

std::vector<sim::Incident> incidents_of(const Eigen::MatrixXd& rows) {
  if (rows.cols() != incident_columns) throw InputError("the incidents have other columns");
  std::vector<sim::Incident> incidents;
  for (Eigen::Index k = 0; k < rows.rows(); ++k)
    incidents.push_back({static_cast<sim::Incident::Kind>(static_cast<int>(rows(k, 0))), rows(k, 1), rows(k, 2),
                         rows(k, 3), static_cast<int>(rows(k, 4)), static_cast<long>(rows(k, 5))});
  return incidents;
}

Json json_of(const RunFacts& facts) {
  Json json = {{"steps", facts.steps}, {"simulated_time", facts.time}, {"largest_strain", facts.largest_strain}};
  const sim::SolveCounts& s = facts.solves;
  json["solves"] = {s.solves, s.iterations, s.tightened, s.by_cholesky, s.failures};
  json["incidents"] = Json::array();
  for (const sim::Incident& i : facts.incidents)
    json["incidents"].push_back({static_cast<int>(i.kind), i.begin, i.end, i.seen, i.halvings, i.discarded});
  return json;
}

RunFacts facts_of(const Json& json) {
  RunFacts facts{json.at("steps"), json.at("simulated_time"), {}, {}, json.at("largest_strain")};
  const Json& s = json.at("solves");
  facts.solves = {s.at(0), s.at(1), s.at(2), s.at(3), s.at(4)};
  for (const Json& i : json.at("incidents"))
    facts.incidents.push_back(
        {static_cast<sim::Incident::Kind>(i.at(0).get<int>()), i.at(1), i.at(2), i.at(3), i.at(4), i.at(5)});
  return facts;
}

Json read_json(const fs::path& file) {
  std::ifstream stream(file);
  const Json json = Json::parse(stream, nullptr, false);
  if (!json.is_object() || !json.contains("motion"))
    throw InputError(fmt::format("{}: is no record of states; simulate again", file.string()));
  return json;
}

// Says the file before what is wrong with its contents.
template <class Work>
auto in_file(const fs::path& file, const Work& work) {
  try {
    return work();
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}; simulate again", file.string(), error.what()));
  }
}

}  // namespace

StateStore::StateStore(fs::path folder, const Scene& scene, const StepChoice& choice, int particles)
    : folder_(std::move(folder)),
      motion_hash_(scene.motion_hash),
      fps_(scene.render.fps),
      step_(choice.step),
      particles_(particles) {}

fs::path StateStore::file(double moment) const {
  const long frame = std::lround(moment * fps_) + 1;
  const bool is_frame = std::abs(static_cast<double>(frame - 1) / fps_ - moment) <= Schedule::together;
  return folder_ / (is_frame ? fmt::format("frame_{:04}{}", frame, extension)
                             : fmt::format("time_{:015.9f}{}", moment, extension));
}

bool StateStore::holds_this_run() const {
  const fs::path file = folder_ / record_name;
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  const Json json = read_json(file);
  const auto differs = [&](const char* key, const auto& expected) { return json.value(key, Json()) != Json(expected); };
  if (differs("motion", motion_hash_))
    throw InputError(fmt::format(
        "{}: these states are of a scene that moves otherwise; simulate this one into another folder", file.string()));
  if (differs("billow", version()) || differs("step", step_))
    throw InputError(
        fmt::format("{}: these states were simulated by billow {} with steps of {} s, and this is billow "
                    "{} with steps of {} s; simulate again",
                    file.string(), json.value("billow", "?"), json.value("step", 0.0), version(), step_));
  return true;
}

StateStore::Record StateStore::read_record(const fs::path& folder) {
  const fs::path file = folder / record_name;
  return in_file(file, [&] {
    const Json json = read_json(file);
    return Record{facts_of(json.at("facts")), json.at("frames"), json.at("finished"), json.at("divergence")};
  });
}

void StateStore::write_record(const Record& record) const {
  const Json json = {{"billow", version()},
                     {"motion", motion_hash_},
                     {"fps", fps_},
                     {"particles", particles_},
                     {"step", step_},
                     {"frames", record.frames},
                     {"finished", record.finished},
                     {"divergence", record.divergence},
                     {"facts", json_of(record.facts)}};
  write_file_atomically(folder_ / record_name, json_text(json, 1) + "\n");
}

bool StateStore::has(double moment) const {
  std::error_code error;
  return fs::is_regular_file(file(moment), error);
}

const Eigen::MatrixXd& StateStore::sized(const Eigen::MatrixXd& field, const fs::path& file) const {
  if (field.rows() != particles_ || field.cols() != 3)
    throw InputError(fmt::format("{}: holds {} x {} numbers where the scene has {} particles; simulate again",
                                 file.string(), field.rows(), field.cols(), particles_));
  return field;
}

sim::WatchedRun::Sample StateStore::read(double moment) const {
  const fs::path from = file(moment);
  const Npz contents = read_npz(from);
  return {contents.number_at("moment"),
          {sized(contents.matrix_at("position"), from), sized(contents.matrix_at("velocity"), from),
           contents.number_at("time")}};
}

void StateStore::write(const sim::WatchedRun::Sample& sample) const {
  Npz contents;
  contents.matrix["position"] = sample.state.position;
  contents.matrix["velocity"] = sample.state.velocity;
  contents.number["time"] = sample.state.time;
  contents.number["moment"] = sample.time;
  write_npz(file(sample.time), contents);
}

std::optional<sim::WatchedRun::Checkpoint> StateStore::read_checkpoint() const {
  const fs::path from = folder_ / checkpoint_name;
  std::error_code error;
  if (!fs::is_regular_file(from, error)) return std::nullopt;
  const Npz npz = read_npz(from);
  const auto number = [&](const char* name) { return npz.number_at(name); };
  const auto whole = [&](const char* name) { return static_cast<long>(npz.number_at(name)); };
  const auto field = [&](const char* name) { return sized(npz.matrix_at(name), from); };
  sim::WatchedRun::Checkpoint c;
  c.solver = {{field("position"), field("velocity"), number("time")},
              {field("previous_position"), field("previous_velocity"), number("previous_time")},
              whole("ticks"),
              whole("steps"),
              number("work"),
              number("largest_strain")};
  c.halvings = static_cast<int>(whole("halvings"));
  c.baseline = number("baseline"), c.energy_share = number("energy_share");
  c.calm = static_cast<int>(whole("calm")), c.calm_needed = static_cast<int>(whole("calm_needed"));
  c.incident_open = whole("incident_open") != 0;
  c.steps = whole("sampled_steps"), c.time = number("sampled_time");
  c.incidents = incidents_of(npz.matrix_at("incidents"));
  c.solves = {whole("solves"), whole("iterations"), whole("tightened"), whole("by_cholesky"), whole("failures")};
  return c;
}

// Whole numbers are exact in a double up to 2^53.
void StateStore::write_checkpoint(const sim::WatchedRun::Checkpoint& c) const {
  Npz npz;
  npz.matrix = {{"position", c.solver.state.position},
                {"velocity", c.solver.state.velocity},
                {"previous_position", c.solver.previous.position},
                {"previous_velocity", c.solver.previous.velocity},
                {"incidents", matrix_of(c.incidents)}};
  const auto whole = [](long value) { return static_cast<double>(value); };
  npz.number = {{"time", c.solver.state.time},
                {"previous_time", c.solver.previous.time},
                {"ticks", whole(c.solver.ticks)},
                {"steps", whole(c.solver.steps)},
                {"work", c.solver.work},
                {"largest_strain", c.solver.largest_strain},
                {"halvings", whole(c.halvings)},
                {"baseline", c.baseline},
                {"energy_share", c.energy_share},
                {"calm", whole(c.calm)},
                {"calm_needed", whole(c.calm_needed)},
                {"incident_open", whole(c.incident_open)},
                {"sampled_steps", whole(c.steps)},
                {"sampled_time", c.time},
                {"solves", whole(c.solves.solves)},
                {"iterations", whole(c.solves.iterations)},
                {"tightened", whole(c.solves.tightened)},
                {"by_cholesky", whole(c.solves.by_cholesky)},
                {"failures", whole(c.solves.failures)}};
  write_npz(folder_ / checkpoint_name, npz);
}

void check_stored_states(const fs::path& run) {
  std::error_code error;
  const fs::path folder = run / StateStore::folder_name;
  if (!fs::is_regular_file(folder / StateStore::record_name, error))
    throw InputError(fmt::format("{}: there are no states; write them with 'billow simulate'", folder.string()));
}

void check_stored_frames(const fs::path& folder, const StateStore::Record& record, long wanted) {
  if (!record.finished)
    throw InputError(
        fmt::format("{}: this simulation has not finished; go on with 'billow simulate --resume'", folder.string()));
  if (record.frames < wanted && record.divergence.empty())
    throw InputError(fmt::format("{}: there are {} frames, and the scene has {}; go on with 'billow simulate --resume'",
                                 folder.string(), record.frames, wanted));
}

namespace {

bool is_state(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name == StateStore::record_name || name == StateStore::checkpoint_name) return true;
  const bool named = name.starts_with("frame_") || name.starts_with("time_");
  const std::string stem = file.stem().string();
  return named && file.extension() == extension &&
         stem.find_first_not_of("0123456789.", stem.find('_') + 1) == std::string::npos;
}

}  // namespace

void remove_states(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_regular_file(error) && is_state(entry.path())) found.push_back(entry.path());
  for (const fs::path& file : found) fs::remove(file, error);
  if (fs::is_directory(folder, error)) fs::remove(folder, error);  // only if it is empty now
}

}  // namespace billow::cli
