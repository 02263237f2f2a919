// A run from its first look at the folder to its last message.
#include "cli/run/render_scene.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/run/film.h"
#include "cli/run/interrupt.h"
#include "cli/run/run_facts.h"
#include "cli/run/run_record.h"
#include "sim/limit/measured_limit.h"

namespace billow::cli {

namespace {

void say_start(const Progress& progress, const Run& run) {
  const sim::Structure& structure = run.simulation.structure();
  progress.say(fmt::format("{}: {} particles, {} springs, k0 = {:.4g} /s², {} at {:.4g} s a step ({})",
                           run.scene.file.string(), structure.particles(), structure.springs(), run.choice.k0.value,
                           sim::name(run.scene.solver.method), run.choice.step, run.choice.bound));
}

using Warnings = std::vector<std::string>;

Warnings warnings_before(const StepChoice& choice) {
  Warnings warnings;
  if (choice.limit && choice.step > *choice.limit)
    warnings.push_back(
        fmt::format("the step is above the certified limit of {:.4g} s; the run may diverge", *choice.limit));
  for (const std::string& law : choice.unbounded)
    warnings.push_back(fmt::format("the step limit does not count {}, which has no bound; the run may diverge", law));
  if (!choice.k0.converged) warnings.push_back("the power method did not settle; k0 may be a little too low");
  return warnings;
}

void say(const Progress& progress, const Warnings& warnings) {
  for (const std::string& warning : warnings) progress.say("warning: " + warning);
}

// How far the energy climbed above its lowest value so far, as a share of what the run can turn over.
double energy_climb(const FilmReport& report, double scale) {
  double lowest = INFINITY, climb = 0.0;
  for (const FrameRecord& frame : report.frames) {
    const double energy = frame.kinetic + frame.potential;
    lowest = std::min(lowest, energy);
    climb = std::max(climb, energy - lowest);
  }
  return scale > 0.0 ? climb / scale : 0.0;
}

// What puts energy in, such as muscles, may do so.
std::optional<std::string> warning_of_energy(const Run& run, const FilmReport& report) {
  const sim::Forces& forces = run.simulation.forces();
  if (!forces.passive()) return std::nullopt;
  const double climb = energy_climb(
      report, sim::energy_scale(run.simulation.structure(), forces, run.scene.gravity, run.simulation.initial_state()));
  if (climb <= 0.05) return std::nullopt;
  return fmt::format(
      "the energy climbed by {:.0f} % of the weight times the size, which nothing physical does; take a smaller step, "
      "or the conserving form for a force filter",
      100.0 * climb);
}

// What the conjugate gradient could not do, and what to do instead. Tightening alone costs little and mends all.
void add_warnings_of_solves(const sim::SolveCounts& solves, Warnings& warnings) {
  if (solves.by_cholesky > 0)
    warnings.push_back(
        fmt::format("the conjugate gradient gave up on {} of {} linear solves, which sparse Cholesky took over; choose "
                    "'solver.linear_solver: cholesky', raise solver.max_iterations or take a smaller step",
                    solves.by_cholesky, solves.solves));
  if (solves.failures > 0)
    warnings.push_back(fmt::format(
        "{} of {} linear solves failed, by Cholesky too, so the motion is wrong from the first of them on; take a "
        "smaller step or softer springs",
        solves.failures, solves.solves));
}

Warnings warnings_after(const Run& run, const FilmReport& report) {
  Warnings warnings;
  if (const auto warning = warning_of_energy(run, report)) warnings.push_back(*warning);
  add_warnings_of_solves(report.solves, warnings);
  return warnings;
}

void say_end(const Progress& progress, const FilmReport& report, const Survey& survey, const OutputFolder& folder) {
  const std::string kept = report.images_kept ? fmt::format(" ({} kept)", report.images_kept) : "";
  const std::string strip =
      report.strip_columns ? fmt::format(", velocity_strip.png ({} columns)", report.strip_columns) : "";
  progress.say(fmt::format(
      "wrote {} images{}{}, run.json and index.html to {} in {:.1f} s (survey {:.1f}, simulate {:.1f}, draw "
      "{:.1f}, encode {:.1f}; the last three overlap)",
      report.images_written, kept, strip, folder.path().string(), survey.cost.wall + report.total.wall,
      survey.cost.wall, report.simulate.wall, report.draw.wall, report.encode.wall));
}

}  // namespace

std::filesystem::path output_of(const RenderOptions& options) {
  return options.output.empty() ? std::filesystem::path("out") / options.scene.stem() : options.output;
}

FrameRange range_of(const RenderOptions& options, const Scene& scene) {
  const long frames = frame_count(scene);
  if (!options.frames) return {1, frames};
  if (options.frames->last > frames)
    throw InputError(fmt::format("--frames {}-{}: the scene has frames 1 to {}", options.frames->first,
                                 options.frames->last, frames));
  return *options.frames;
}

int render_scene(const Scene& scene, const Simulation& simulation, const StepChoice& choice,
                 const RenderOptions& options) {
  const int threads = options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
  catch_interrupts();
  OutputFolder folder(output_of(options), options.existing, scene.hash, scene.render.views);
  Progress progress(options.progress);
  const DrawnScene drawn(scene, simulation);
  const Run run{scene, simulation, drawn, choice, options.command};
  say_start(progress, run);
  Warnings warnings = warnings_before(choice);
  say(progress, warnings);

  const Survey found = survey(run, progress);
  if (interrupted_by() != 0) return 128 + interrupted_by();
  folder.begin_run();
  write_file_atomically(folder.file(RunFile::record), begun_record(scene, options.command));
  const FilmReport report = make_film(run, found.bounds, range_of(options, scene), folder, threads, progress);
  write_finished_record(folder.file(RunFile::record), run, found, report);
  const Warnings late = warnings_after(run, report);
  say(progress, late);
  warnings.insert(warnings.end(), late.begin(), late.end());
  write_file_atomically(folder.file(RunFile::page), run_page_html(describe_run(run, found, report, warnings)));
  say_end(progress, report, found, folder);
  if (report.interrupted_by) return 128 + report.interrupted_by;
  if (report.divergence) throw DivergenceError(*report.divergence);
  return 0;
}

}  // namespace billow::cli
