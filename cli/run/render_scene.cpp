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
#include "cli/run/given_bounds.h"
#include "cli/run/incident_text.h"
#include "cli/run/interrupt.h"
#include "cli/run/run_facts.h"
#include "cli/run/run_record.h"
#include "cli/scene/step_warnings.h"

namespace billow::cli {

namespace {

void say_start(Progress& progress, const Run& run) {
  const sim::Structure& structure = run.simulation.structure();
  progress.say(fmt::format("{}: {} particles, {} springs, k0 = {:.4g} /s², {} at {:.4g} s a step ({})",
                           run.scene.file.string(), structure.particles(), structure.springs(), run.choice.k0.value,
                           sim::name(run.scene.solver.method), run.choice.step, run.choice.bound));
}

using Warnings = std::vector<std::string>;

void say(Progress& progress, const Warnings& warnings) {
  for (const std::string& warning : warnings) progress.say("warning: " + warning);
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

// Below it, motion that one sees is slowed by as much again as its response's root.
constexpr double least_response = 0.9;

Warnings warnings_after(const Run& run, const FilmReport& report) {
  Warnings warnings;
  for (const sim::Incident& incident : report.incidents) warnings.push_back(incident_text(incident, run.choice.step));
  if (report.largest_strain > sim::suspect_strain)
    warnings.push_back(fmt::format(
        "a spring was stretched by {:.3g} times its rest length, which its stiffness allowed", report.largest_strain));
  if (report.filter_response && *report.filter_response < least_response)
    warnings.push_back(
        fmt::format("the filter passes {:.0f} % of the motion's own accelerations, so that what one sees is slowed; "
                    "take a smaller ratio, a larger lambda or fewer passes",
                    100.0 * *report.filter_response));
  add_warnings_of_solves(report.solves, warnings);
  return warnings;
}

void say_end(Progress& progress, const FilmReport& report, const OutputFolder& folder) {
  const std::string kept = report.images_kept ? fmt::format(" ({} kept)", report.images_kept) : "";
  const std::string strip =
      report.strip_columns ? fmt::format(", velocity_strip.png ({} columns)", report.strip_columns) : "";
  progress.say(fmt::format("wrote {} images{}{}, run.json and index.html to {} in {}", report.images_written, kept,
                           strip, folder.path().string(), time_taken(progress, report)));
}

// What the pictures need to know beforehand: from the scene where it says it all, else from a survey.
Survey look_ahead(const Run& run, Progress& progress) {
  if (const auto bounds = given_bounds(run)) return {*bounds, {}};
  progress.phase("survey");
  return survey(run, progress);
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
                 const RenderOptions& options, Progress& progress) {
  const int threads = options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
  catch_interrupts();
  OutputFolder folder(output_of(options), options.existing, scene.hash, scene.render.views);
  progress.phase("surfaces");
  const DrawnScene drawn(scene, simulation);
  const Run run{scene, simulation, drawn, choice, options.command};
  say_start(progress, run);
  Warnings warnings = step_warnings(simulation.structure(), choice);
  say(progress, warnings);

  const Survey found = look_ahead(run, progress);
  if (interrupted_by() != 0) return 128 + interrupted_by();
  progress.phase("render");
  folder.begin_run();
  write_file_atomically(folder.file(RunFile::record), begun_record(scene, options.command));
  const FilmReport report = make_film(run, found.bounds, range_of(options, scene), folder, threads, progress);
  progress.phase("writing");
  const Warnings late = warnings_after(run, report);
  say(progress, late);
  warnings.insert(warnings.end(), late.begin(), late.end());
  write_file_atomically(folder.file(RunFile::page), run_page_html(describe_run(run, report, warnings, progress)));
  // Last, so that its times leave nothing out.
  write_finished_record(folder.file(RunFile::record), run, found, report, progress);
  say_end(progress, report, folder);
  if (report.interrupted_by) return 128 + report.interrupted_by;
  if (report.divergence) throw DivergenceError(*report.divergence);
  return 0;
}

}  // namespace billow::cli
