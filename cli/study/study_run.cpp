// Rendering, measuring and timing one run.
#include "cli/study/study_run.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>

#include "base/error.h"
#include "base/process_start.h"
#include "cli/run/interrupt.h"
#include "cli/run/measured_run.h"
#include "cli/run/render_scene.h"
#include "cli/run/state_store.h"
#include "cli/run/watched_scene.h"
#include "cli/scene/hash.h"
#include "cli/scene/scene_parts.h"
#include "cli/study/reference_error.h"
#include "cli/text/command_text.h"
#include "cli/text/version.h"
#include "sim/limit/paper_step.h"

namespace billow::cli {

namespace {

void add(RunResult& result, const std::string& column, std::optional<double> value) {
  if (value && std::isfinite(*value)) result.values.emplace_back(column, *value);
}

// Limits also as multiples of what the method stands without a filter: 2 / sqrt(k0), or 2 sqrt(2) / sqrt(k0).
void add_limit(RunResult& result, const std::string& column, std::optional<double> step,
               std::optional<double> unfiltered) {
  add(result, column, step);
  if (step && unfiltered) add(result, column + "_ratio", *step / *unfiltered);
}

void add_limits(RunResult& result, const Scene& scene, const Simulation& simulation, const StepChoice& choice) {
  const std::optional<double> unfiltered = sim::paper_step(scene.solver.method, choice.k0.value);
  add(result, "duration", scene.duration);
  add(result, "particles", simulation.structure().particles());
  add(result, "springs", simulation.structure().springs());
  add(result, "k0", choice.k0.value);
  add(result, "unfiltered", unfiltered);
  add_limit(result, "paper", choice.paper, unfiltered);
  add_limit(result, "certified", choice.certified, unfiltered);
  add_limit(result, "any_shape", choice.any_shape, unfiltered);
  if (choice.step > 0.0) add_limit(result, "step", choice.step, unfiltered);
}

void add_measured(RunResult& result, const Scene& scene, const Simulation& simulation, const StepChoice& choice) {
  const Simulation::Phase& phase = simulation.phase(choice.phase);
  const sim::MeasuredStep measured = measure_step(scene, phase, simulation.initial_state(), scene.solver.method,
                                                  phase.filter, choice.limit, choice.k0.value);
  if (!measured.unlimited)
    add_limit(result, "measured", measured.step, sim::paper_step(scene.solver.method, choice.k0.value));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The whole scene, stepped on one thread and not drawn. The certificate has warmed the caches already.
void add_times(RunResult& result, const Scene& scene, const Simulation& simulation, const StepChoice& choice,
               int repeats) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<double> wall, processor;
  for (int k = 0; k < repeats && interrupted_by() == 0; ++k) {
    const auto solver = simulation.make_solver(choice);
    const auto begin = std::chrono::steady_clock::now();
    const double begin_processor = processor_seconds();
    solver->sample(scene.duration);
    processor.push_back(processor_seconds() - begin_processor);
    wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    if (k > 0) continue;
    const sim::SolveCounts solves = solver->solve_counts();
    add(result, "steps", static_cast<double>(solver->steps()));
    if (solves.solves > 0)
      add(result, "iterations_per_solve", static_cast<double>(solves.iterations) / static_cast<double>(solves.solves));
  }
  add(result, "seconds", median(wall));
  add(result, "cpu_seconds", median(processor));
}

void add_error(RunResult& result, const Study& study, const StudyRun& run, const Simulation& simulation,
               const StepChoice& choice) {
  std::vector<Override> changes = overrides_of(study, run);
  const ReferenceSpec& spec = study.measures.error;
  changes.insert(changes.end(), spec.changes.begin(), spec.changes.end());
  const Scene scene = read_scene(study.scene, changes);
  const Simulation reference(scene);
  const ReferenceError error =
      located(spec.where, [&] { return reference_error(simulation, choice, reference, spec.until); });
  add(result, "error", error.rms);
  add(result, "error_worst", error.worst);
  add(result, "energy", error.energy);
  add(result, "reference_energy", error.reference_energy);
}

// Whether the film was begun by another process, and has states to go on from.
bool was_begun(const std::filesystem::path& film, const Scene& scene, const Simulation& simulation,
               const StepChoice& choice) {
  const StateStore states(film / StateStore::folder_name, scene, choice, simulation.structure().particles());
  try {
    return is_of_scene(film, scene) && states.holds_this_run();
  } catch (const InputError&) {
    return false;  // they are of another version, or damaged
  }
}

void render_run(const Study& study, const StudyRun& run, const Scene& scene, const Simulation& simulation,
                const StepChoice& choice, const std::filesystem::path& folder, const RunConduct& conduct,
                Progress& progress) {
  RenderOptions options;
  options.backend = conduct.backend;
  options.scene = study.scene;
  options.output = folder / "film";
  options.existing = was_begun(options.output, scene, simulation, choice) ? Existing::resume : Existing::overwrite;
  options.threads = conduct.threads;
  options.keep_states = conduct.keep_states || options.existing == Existing::resume;
  make_folder_within(folder, "film");
  options.command = command_of(study, run);
  const std::filesystem::path states = options.output / StateStore::folder_name;
  try {
    const int status = render_scene(scene, simulation, choice, options, progress);
    if (interrupted_by() != 0) return;
    if (status != 0) throw std::runtime_error(fmt::format("the rendering was stopped with status {}", status));
  } catch (const DivergenceError&) {  // a film that is as whole as it will be
    if (options.keep_states) remove_states(states);
    throw;
  }
  if (options.keep_states) remove_states(states);
}

// A divergence is a result.
void or_diverged(RunResult& result, const auto& measure) {
  try {
    measure();
  } catch (const DivergenceError& error) {
    result.status = RunStatus::diverged;
    result.message = error.what();
  }
}

}  // namespace

std::string run_hash(const Study& study, const Scene& scene) {
  Hash hash;
  hash.add(version());
  hash.add(scene.hash);
  const Measures& measures = study.measures;
  hash.add(fmt::format("render {} measured {} repeats {} error {}", measures.render, measures.measured,
                       measures.repeats, measures.error.until));
  for (const Override& change : measures.error.changes) hash.add(change.path + "=" + change.value);
  return hash.hex();
}

std::string command_of(const Study& study, const StudyRun& run) {
  if (!study.measures.render)
    return command_line({"billow", "study", study.file.string(), "--only", std::to_string(run.number)});
  std::vector<std::string> words = {"billow", "render", study.scene.lexically_normal().string()};
  add_overrides(overrides_of(study, run), words);
  return command_line(words);
}

RunResult perform_run(const Study& study, const StudyRun& run, const std::filesystem::path& folder,
                      const RunConduct& conduct) {
  const std::size_t threads = conduct.threads > 0 ? conduct.threads : std::max(1u, std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  Progress progress(ProgressStyle::none, process_start());
  const Scene scene = read_scene(study.scene, overrides_of(study, run), progress);
  RunResult result{RunStatus::done, run_hash(study, scene), command_of(study, run), "", scene.effective, {}};
  progress.phase("springs");
  const Simulation simulation(scene);
  progress.phase("limit");
  // A scheme that grows at every step has limits to report, but no step to run with.
  const bool steps = study.measures.render || study.measures.repeats > 0 || study.measures.error.until > 0.0;
  const StepChoice choice = steps ? simulation.choose_step() : simulation.find_limits();
  add_limits(result, scene, simulation, choice);
  progress.phase("measuring");
  or_diverged(result, [&] {
    if (study.measures.measured) add_measured(result, scene, simulation, choice);
    if (study.measures.repeats > 0) add_times(result, scene, simulation, choice, study.measures.repeats);
    if (study.measures.error.until > 0.0) add_error(result, study, run, simulation, choice);
  });
  // What came before it diverged can be looked at.
  or_diverged(result, [&] {
    if (study.measures.render) render_run(study, run, scene, simulation, choice, folder, conduct, progress);
  });
  if (interrupted_by() == 0) write_result(folder, result);
  return result;
}

}  // namespace billow::cli
