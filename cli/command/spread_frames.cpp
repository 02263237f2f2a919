// billow render --commands and --slurm: a scene's frames, for other processes to draw.
#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/process_start.h"
#include "cli/cluster/slurm_script.h"
#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/run/state_store.h"
#include "cli/run/watched_scene.h"
#include "cli/run/whole_frames.h"
#include "cli/text/terminal.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

/// Frames, and who draws them of which states.
struct FramesWork {
  const RenderOptions& options;
  const SpreadOptions& spread;
  fs::path folder, states;
  std::vector<long> unfinished;
  std::string asked;  // --frames, where not all are
};

CommandWords scene_words(const FramesWork& work, const char* command) {
  CommandWords words = {command, work.options.scene.string()};
  add_overrides(work.options.overrides, words);
  if (work.spread.untrusted) words.push_back("--untrusted");
  if (work.options.durable) words.push_back("--durable");
  return words;
}

CommandWords drawing_words(const FramesWork& work) {
  CommandWords words = scene_words(work, "render");
  words.insert(words.end(), {"--from", work.states.string()});
  if (work.folder != work.states) words.insert(words.end(), {"-o", work.folder.string()});
  if (!work.spread.backend.empty()) words.insert(words.end(), {"--backend", work.spread.backend});
  return words;
}

// Of a run that is there; check_output_folder() has seen that it is of this scene.
std::vector<long> unfinished_frames(const FrameRange& range, const fs::path& folder, const Scene& scene) {
  if (!is_of_scene(folder, scene)) return frames_of_range(range);
  return missing_frames(range, find_frames(folder, scene, range).whole);
}

void print_commands(const FramesWork& work, const CommandWords& lists) {
  CommandWords words = drawing_words(work);
  words.insert(words.begin(), this_program());
  words.push_back("--frames-only");
  if (work.options.threads > 0) words.insert(words.end(), {"--threads", std::to_string(work.options.threads)});
  for (const std::string& list : lists) print_text(fmt::format("{} --frames {}\n", shell_line(words), list));
}

std::string no_fault_of_divergence() {
  return fmt::format("if [ $status = {} ]; then status=0; fi", static_cast<int>(exit_diverged));
}

SlurmJob simulating_job(const FramesWork& work) {
  CommandWords words = scene_words(work, "simulate");
  words.insert(words.end(), {"-o", work.states.string(), "--resume"});
  SlurmJob job;
  job.name = "simulate";
  job.about = "The states, and what is made of them besides frames.";
  job.lines = {fmt::format("{} {} {}", job_program, shell_line(words), job_threads),
               "# Where it has diverged, the frames before that are drawn; collecting says so.",
               no_fault_of_divergence()};
  job.can_be_stopped = true;
  return job;
}

SlurmJob drawing_job(const FramesWork& work, const CommandWords& lists) {
  SlurmJob job;
  job.name = "frames";
  job.about = "Each task draws its frames, where they are not there by then.";
  if (work.options.from.empty()) job.after = "afterok:simulate";
  job.tasks = lists;
  job.lines = {fmt::format("{} {} --frames {} --frames-only {}", job_program, shell_line(drawing_words(work)),
                           job_piece, job_threads),
               no_fault_of_divergence()};
  job.can_be_stopped = true;
  return job;
}

SlurmJob collecting_job(const FramesWork& work, bool draws) {
  CommandWords words = drawing_words(work);
  if (!work.asked.empty()) words.insert(words.end(), {"--frames", work.asked});
  SlurmJob job;
  job.name = "collect";
  job.about = "Record and page of the frames that are there, however the tasks have ended.";
  job.after = draws ? "afterany:frames" : work.options.from.empty() ? "afterok:simulate" : "";
  job.lines = {fmt::format("{} {} --collect {}", job_program, shell_line(words), job_threads)};
  if (work.spread.video) {  // of what there is, also where that is not all
    job.lines.front() += " && status=0 || status=$?";
    job.lines.push_back(fmt::format("{} {}", job_program, shell_line({"video", work.folder.string(), "--overwrite"})));
    job.lines.push_back("exit $status");
  }
  return job;
}

SlurmScript script_of(const FramesWork& work, const CommandWords& lists) {
  SlurmScript script;
  script.title = work.options.scene.stem().string();
  script.output = work.folder;
  script.threads = work.options.threads;
  script.about = fmt::format("# {} frames of {} are to be drawn: {} tasks, and what collects them.\n",
                             work.unfinished.size(), work.options.scene.string(), lists.size());
  if (work.options.from.empty()) script.jobs.push_back(simulating_job(work));
  if (!lists.empty()) script.jobs.push_back(drawing_job(work, lists));
  script.jobs.push_back(collecting_job(work, !lists.empty()));
  return script;
}

}  // namespace

int spread_frames_command(const RenderOptions& options, const SpreadOptions& spread) {
  if (spread.commands && options.from.empty())
    throw InputError(
        "--commands: lines have no order, and frames are drawn of states; write these with 'billow simulate', and say "
        "--from");
  Progress progress(options.progress, process_start());
  const Scene scene = read_scene(options.scene, options.overrides, progress);
  const FrameRange range = range_of(options, scene);
  const fs::path folder = output_of(options);
  if (!options.from.empty()) {
    check_stored_states(options.from);
    const fs::path states = options.from / StateStore::folder_name;
    check_stored_frames(states, StateStore::read_record(states), frame_count(scene));
  }
  check_output_folder(folder, Existing::resume, scene);
  FramesWork work{
      options, spread, folder, options.from.empty() ? folder : options.from, unfinished_frames(range, folder, scene),
      ""};
  if (range.count() < frame_count(scene)) work.asked = list_text(frames_of_range(range));
  // Two tasks for each that may run at a time: who is done early takes another.
  const auto tasks = static_cast<std::size_t>(2 * spread.array_limit);
  const CommandWords lists = lists_of(work.unfinished, pieces_a_task(work.unfinished.size(), spread.chunk, tasks));
  if (spread.commands)
    print_commands(work, lists);
  else
    hand_over(script_of(work, lists), spread);
  return exit_done;
}

}  // namespace billow::cli
