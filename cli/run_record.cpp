// Writing run.json.
#include "cli/run_record.h"

#include <nlohmann/json.hpp>

#include "cli/version.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

Json begun(const Scene& scene, const std::string& command, const char* status) {
  return {{"billow", version()},
          {"status", status},
          {"command", command},
          {"scene", {{"file", scene.file.string()}, {"hash", scene.hash}, {"effective", scene.effective}}}};
}

Json estimate(const sim::EigenvalueEstimate& e) {
  return {{"value", e.value}, {"iterations", e.iterations}, {"converged", e.converged}};
}

Json optional(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json solver_record(const Scene& scene, const StepChoice& choice, const FilmReport& report) {
  Json json = {{"method", sim::name(scene.solver.method)},
               {"step", choice.step},
               {"step_from", choice.bound},
               {"limits",
                {{"paper", optional(choice.paper)},
                 {"certified", optional(choice.certified)},
                 {"any_shape", optional(choice.any_shape)}}},
               {"k0", estimate(choice.k0)}};
  if (choice.filtered) json["filtered_eigenvalue"] = estimate(*choice.filtered);
  json["steps"] = report.steps;
  json["simulated_time"] = report.simulated_time;
  json["linear_solves"] = {{"count", report.solves.solves},
                           {"iterations", report.solves.iterations},
                           {"not_converged", report.solves.failures}};
  return json;
}

Json frame_record(const FrameRecord& f) {
  const auto list = [](const Eigen::Vector3d& v) { return Json{v.x(), v.y(), v.z()}; };
  return {{"frame", f.frame},
          {"time", f.time},
          {"kinetic_energy", f.kinetic},
          {"potential_energy", f.potential},
          {"linear_momentum", list(f.linear_momentum)},
          {"angular_momentum", list(f.angular_momentum)}};
}

}  // namespace

std::string begun_record(const Scene& scene, const std::string& command) {
  return begun(scene, command, "running").dump(2) + "\n";
}

std::string finished_record(const Scene& scene, const std::string& command, const Simulation& simulation,
                            const StepChoice& choice, const Survey& survey, const FilmReport& report) {
  const char* status = report.divergence ? "diverged" : report.interrupted_by ? "interrupted" : "done";
  Json json = begun(scene, command, status);
  if (report.divergence) json["divergence"] = *report.divergence;
  json["particles"] = simulation.structure().particles();
  json["springs"] = simulation.structure().springs();
  json["solver"] = solver_record(scene, choice, report);
  json["velocity_range"] = report.velocity_range;
  json["images_written"] = report.images_written;
  json["images_kept"] = report.images_kept;
  json["strip_columns"] = report.strip_columns;
  json["seconds"] = {{"survey", survey.seconds},
                     {"simulate", report.simulate_seconds},
                     {"draw", report.draw_seconds},
                     {"encode", report.encode_seconds},
                     {"wall", survey.seconds + report.wall_seconds}};
  json["gl"] = report.gl;
  json["frames"] = Json::array();
  for (const FrameRecord& frame : report.frames) json["frames"].push_back(frame_record(frame));
  return json.dump(1) + "\n";
}

}  // namespace billow::cli
