// A run from its first look at the folder to its last message.
#include "cli/run/render_scene.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/folder_lock.h"
#include "base/readable_number.h"
#include "cli/run/film.h"
#include "cli/run/given_bounds.h"
#include "cli/run/incident_text.h"
#include "cli/run/interrupt.h"
#include "cli/run/run_facts.h"
#include "cli/run/run_record.h"
#include "cli/run/run_warnings.h"
#include "cli/run/simulated_states.h"
#include "cli/run/spooled_states.h"
#include "cli/run/whole_frames.h"
#include "cli/scene/mesh_warnings.h"
#include "cli/scene/step_warnings.h"
#include "render/gl/gl_context.h"

namespace billow::cli {

namespace {

void say_start(Progress& progress, const Run& run) {
  const sim::Structure& structure = run.simulation.structure();
  progress.say(fmt::format("{}: {}, {}, k0 = {} /s², {} at {:.4g} s a step ({})", run.scene.file.string(),
                           counted(structure.particles(), "particle"), counted(structure.springs(), "spring"),
                           readable(run.choice.k0.value, 4), sim::name(run.scene.solver.method), run.choice.step,
                           run.choice.bound));
}

using Warnings = std::vector<std::string>;

void say(Progress& progress, const Warnings& warnings) {
  for (const std::string& warning : warnings) progress.say("warning: " + warning);
}

std::vector<render::View> views_of(const RenderOptions& options, const Scene& scene) {
  return options.simulate_only ? std::vector<render::View>() : scene.render.views;
}

void say_end(Progress& progress, const FilmReport& report, const OutputFolder& folder, const RenderOptions& options) {
  const std::string kept = report.images_kept ? fmt::format(" ({} kept)", grouped(report.images_kept)) : "";
  const std::string strip = report.strip_columns && options.from.empty()
                                ? fmt::format(", velocity_strip.png ({})", counted(report.strip_columns, "column"))
                                : "";
  const std::string main = options.simulate_only
                               ? "the states of " + counted(static_cast<long>(report.frames.size()), "frame")
                               : counted(report.images_written, "image") + kept;
  progress.say(fmt::format("{} {}{}, run.json and index.html to {} in {}", options.collect ? "collected" : "wrote",
                           main, strip, folder.path().string(), time_taken(progress, report)));
}

// What lacks of what was to be collected, and how it comes about.
void say_missing(Progress& progress, const std::vector<long>& missing) {
  progress.say(fmt::format("{} missing or damaged; draw them with --frames {}, and collect again",
                           counted(static_cast<long>(missing.size()), "frame is", "frames are"), list_text(missing)));
}

// Last bits of frames that are kept may be others than what draws now would give.
void warn_of_mixture(const nlohmann::json& before, const FilmReport& report, Warnings& warnings) {
  const bool known = before.is_object() && before.contains("gl") && before["gl"].is_string();
  const std::string drew = known ? before["gl"] : "";
  if (report.images_kept > 0 && report.images_written > 0 && !drew.empty() && drew != report.gl)
    warnings.push_back(
        fmt::format("the frames that are kept were drawn by '{}', the others by '{}': they may differ in "
                    "last bits; --overwrite draws all by one",
                    drew, report.gl));
}

// Several processes may draw frames of the same states into the same folder.
bool draws_stored(const RenderOptions& options) { return !options.from.empty(); }

bool keeps_states(const RenderOptions& options, const OutputFolder& folder) {
  std::error_code error;
  return options.simulate_only || options.keep_states ||
         (options.existing == Existing::resume && std::filesystem::is_directory(folder.states(), error));
}

// Whether frames that were drawn within the recorded bounds, null for unknown ones, can stay. A run that ended at
// another time may have had other bounds.
bool was_drawn_alike(const nlohmann::json& recorded, const render::RunBounds& bounds) {
  return recorded.is_null() || recorded == nlohmann::json(bounds_record(bounds));
}

/// One run of render_scene.
class SceneRun {
 public:
  SceneRun(const Run& run, const RenderOptions& options, OutputFolder& folder, int threads, Progress& progress)
      : run_(run), options_(options), folder_(folder), threads_(threads), progress_(progress) {}

  int run() {
    try {
      const int status = run_to_its_end();
      if (status > 128) end_early(SuddenEnd::interruption, "");
      return status;
    } catch (const std::exception& error) {
      end_early(SuddenEnd::failure, error.what());
      throw;
    }
  }

 private:
  // Record and page say so, as far as they can be written.
  void end_early(SuddenEnd how, const std::string& reason) noexcept {
    if (!record_ || !record_->end(how, reason)) return;
    try {
      FilmFrames frames{range_of(options_, run_.scene), {}, options_.simulate_only};
      if (!frames.states_alone) frames.there = folder_.frames_drawn(frame_count(run_.scene));
      write_page(describe_unfinished_run(run_, how, reason, frames, warnings_));
    } catch (const std::exception&) {  // the disk may be what failed
    }
  }

  void write_page(const RunPage& page) const {
    write_file_atomically(folder_.file(RunFile::page), run_page_html(page));
  }

  int run_to_its_end() {
    say_start(progress_, run_);
    warnings_ = mesh_warnings(run_.scene);
    for (std::string& warning : step_warnings(run_.simulation.structure(), run_.choice))
      warnings_.push_back(std::move(warning));
    say(progress_, warnings_);
    const bool keeps = !draws_stored(options_) && keeps_states(options_, folder_);
    const nlohmann::json before = earlier_record(folder_.path());
    const nlohmann::json bounds_before = before.is_null() ? nlohmann::json() : before.value("bounds", nlohmann::json());
    if (keeps) write_begun_record(bounds_before), begin();
    look_ahead();
    if (interrupted_by() != 0) return 128 + interrupted_by();
    progress_.phase(options_.simulate_only ? "simulate" : "render");
    const bool alike = was_drawn_alike(bounds_before, survey_.bounds);
    // The record comes first: whatever ends the process now, it does not say of frames that are gone that they are
    // done.
    if (!draws_stored(options_) || before.is_null() || !alike) write_begun_record(bounds_record(survey_.bounds));
    if (!alike) folder_.remove_frames();
    begin();
    FilmReport report = make_film(run_, *states_, survey_.bounds, plan(), folder_, threads_, progress_);
    const bool whole = options_.frames_only ? finish_frames(report) : finish(report, before);
    if (report.interrupted_by) return 128 + report.interrupted_by;
    // A part of a film that lies before its divergence is whole.
    const bool has_its_part = options_.frames_only && report.frames_drawn == range_of(options_, run_.scene).count();
    if (report.divergence && !has_its_part) throw DivergenceError(*report.divergence);
    return whole ? 0 : 1;
  }

  void write_begun_record(const nlohmann::ordered_json& bounds) {
    record_.reset();
    record_.emplace(folder_.file(RunFile::record), begun_record(run_, bounds));
  }

  void begin() {
    if (draws_stored(options_))
      folder_.join_run();
    else
      folder_.begin_run();
    if (keeps_states(options_, folder_)) make_folder_within(folder_.path(), StateStore::folder_name);
  }

  StateStore store(const std::filesystem::path& folder) const {
    return {folder, run_.scene, run_.choice, run_.simulation.structure().particles()};
  }

  std::unique_ptr<StateSource> open_stored(long first_frame) const {
    return std::make_unique<StoredStates>(run_, store(options_.from / StateStore::folder_name), first_frame);
  }

  // `go_on`: from what was kept of this very run as well.
  std::unique_ptr<StateSource> open_states(long last_frame, bool go_on) const {
    if (draws_stored(options_)) return open_stored(1);
    if (!keeps_states(options_, folder_)) return std::make_unique<SimulatedStates>(run_, last_frame);
    return std::make_unique<KeptStates>(run_, last_frame, store(folder_.states()),
                                        go_on || options_.existing == Existing::resume, progress_);
  }

  // What the pictures need to know beforehand: from the scene where it says it all, else from a survey, whose states
  // the film then has.
  void look_ahead() {
    const long last_frame = range_of(options_, run_.scene).last;
    if (options_.frames_only && look_at_record()) return;
    if (const auto bounds = given_bounds(run_)) {
      survey_ = {*bounds, {}};
      states_ = open_states(last_frame, false);
      return;
    }
    progress_.phase("survey");
    const auto states = open_states(frame_count(run_.scene), false);
    auto spool = std::make_unique<SpooledStates>(folder_.file(RunFile::record));
    survey_ = survey(run_, *states, draws_stored(options_) ? nullptr : spool.get(), progress_);
    if (draws_stored(options_) || !spool->whole())
      states_ = open_states(last_frame, true);
    else
      states_ = std::move(spool);
  }

  // What a few frames need is what the simulation has written down; no other states than theirs are read then.
  bool look_at_record() {
    const auto bounds = recorded_bounds(earlier_record(options_.from), run_.scene);
    if (!bounds) return false;
    survey_ = {*bounds, {}};
    states_ = open_stored(range_of(options_, run_.scene).first);
    return true;
  }

  FilmPlan plan() const {
    const FrameRange asked = range_of(options_, run_.scene), all{1, frame_count(run_.scene)}, none;
    return {.drawn = options_.collect ? none : asked,
            .recorded = draws_stored(options_) ? all : asked,
            .views = views_of(options_, run_.scene),
            .only_frames = draws_stored(options_),
            .only_pictures = options_.frames_only,
            .backend = options_.backend};
  }

  // The record stays that of a run that goes on, until it is collected.
  bool finish_frames(const FilmReport& report) {
    settle_names(folder_.path());
    record_.reset();
    progress_.say(fmt::format("wrote {}{} to {}", counted(report.images_written, "image"),
                              report.images_kept ? fmt::format(" ({} kept)", grouped(report.images_kept)) : "",
                              folder_.path().string()));
    return true;
  }

  // The frames that are there. What was to be collected was drawn elsewhere, and is looked at.
  std::vector<long> frames_there(FilmReport& report) const {
    const FrameRange all{1, frame_count(run_.scene)};
    if (!options_.collect) return folder_.frames_drawn(all.last);
    const FoundFrames found = find_frames(folder_.path(), run_.scene, all);
    for (const std::string& fault : found.faults) progress_.say("warning: " + fault);
    report.images_written = static_cast<long>(found.whole.size() * run_.scene.render.views.size());
    return found.whole;
  }

  // Of the frames that were to be collected, and that the run has.
  std::vector<long> missing(const FilmReport& report, const std::vector<long>& there) const {
    std::vector<long> missing;
    if (!options_.collect) return missing;
    for (const long frame : missing_frames(range_of(options_, run_.scene), there))
      if (frame <= report.series.last_frame()) missing.push_back(frame);
    return missing;
  }

  // What the page shows of stored states: where all that the run has is drawn, what a direct run's page does.
  FilmFrames frames_of(const std::vector<long>& there, const FilmReport& report) const {
    const FrameRange all{1, frame_count(run_.scene)};
    const bool whole = static_cast<long>(there.size()) == report.series.last_frame();
    return {all, whole ? std::optional<std::vector<long>>() : there, there.empty()};
  }

  // False when what was to be collected is not all there.
  bool finish(FilmReport& report, const nlohmann::json& before) {
    progress_.phase("writing");
    Warnings late = run_warnings(run_, report);
    warn_of_mixture(before, report, late);
    say(progress_, late);
    warnings_.insert(warnings_.end(), late.begin(), late.end());
    const FolderLock lock(folder_.path());
    nlohmann::ordered_json differing = nlohmann::ordered_json::object();
    FilmFrames frames{range_of(options_, run_.scene), {}, options_.simulate_only};
    std::vector<long> lacking;
    if (draws_stored(options_)) {
      add_made_before(earlier_record(folder_.path()), report);
      const std::vector<long> there = frames_there(report);
      lacking = missing(report, there);
      frames = frames_of(there, report);
      if (frames.there) differing["drawn"] = there;
    }
    if (options_.simulate_only) differing["views"] = nlohmann::ordered_json::array();
    if (options_.keep_states) report.images_written += std::exchange(report.images_kept, 0);
    write_page(describe_run(run_, report, frames, warnings_, progress_));
    settle_names(folder_.path());
    // Last, so that its times leave nothing out.
    write_finished_record(folder_.file(RunFile::record), run_, survey_, report, progress_, differing);
    settle_names(folder_.path());
    record_.reset();
    if (!lacking.empty()) say_missing(progress_, lacking);
    say_end(progress_, report, folder_, options_);
    return lacking.empty();
  }

  const Run& run_;
  const RenderOptions& options_;
  OutputFolder& folder_;
  int threads_;
  Progress& progress_;
  Warnings warnings_;
  Survey survey_;
  std::optional<RunningRecord> record_;  // until the run has its own
  std::unique_ptr<StateSource> states_;
};

}  // namespace

std::filesystem::path output_of(const RenderOptions& options) {
  if (!options.output.empty()) return options.output;
  return draws_stored(options) ? options.from : std::filesystem::path("out") / options.scene.stem();
}

// Where frames of stored states are drawn, others may be there already.
Existing existing_of(const RenderOptions& options) {
  return draws_stored(options) ? Existing::resume : options.existing;
}

FrameRange range_of(const RenderOptions& options, const Scene& scene) {
  const long frames = frame_count(scene);
  return options.frames.empty() ? FrameRange{1, frames} : frames_in(options.frames, frames);
}

void check_backend(const RenderOptions& options) {
  if (!options.simulate_only) render::GlContext(options.backend, options.threads);
}

int render_scene(const Scene& scene, const Simulation& simulation, const StepChoice& choice,
                 const RenderOptions& options, Progress& progress) {
  const int threads = options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
  catch_interrupts();
  OutputFolder folder(output_of(options), existing_of(options), scene, views_of(options, scene));
  if (draws_stored(options) && options.existing == Existing::overwrite) folder.keep_nothing();
  progress.phase("surfaces");
  const DrawnScene drawn(scene, simulation);
  const Run run{scene, simulation, drawn, choice, options.command};
  return SceneRun(run, options, folder, threads, progress).run();
}

}  // namespace billow::cli
