// Lines and jobs.
#include "cli/study/study_spread.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/cluster/slurm_script.h"
#include "cli/text/terminal.h"

namespace billow::cli {

namespace {

CommandWords study_words(const StudyPlan& plan, const SpreadOptions& options) {
  CommandWords words = {"study", plan.study.file.string(), "-o", plan.folder.string()};
  if (plan.untrusted) words.push_back("--untrusted");
  if (!options.backend.empty()) words.insert(words.end(), {"--backend", options.backend});
  return words;
}

void print_commands(const StudyPlan& plan, const CommandWords& lists, const SpreadOptions& options) {
  CommandWords words = study_words(plan, options);
  words.insert(words.begin(), this_program());
  words.insert(words.end(), {"--jobs", "1"});
  if (plan.threads > 0) words.insert(words.end(), {"--threads", std::to_string(plan.threads)});
  if (plan.resume) words.push_back("--resume");
  for (const std::string& list : lists) print_text(fmt::format("{} --runs {}\n", shell_line(words), list));
}

SlurmJob runs_job(const StudyPlan& plan, const CommandWords& lists, const SpreadOptions& options) {
  SlurmJob job;
  job.name = "runs";
  job.about = "Each task does its runs, where they are unfinished then, one after the other.";
  job.tasks = lists;
  // What a run draws can be gone on with; what it measures begins again.
  job.lines = {fmt::format("{} {} --runs {} --jobs 1 {}{}", job_program, shell_line(study_words(plan, options)),
                           job_piece, job_threads, plan.study.measures.render ? " --resume" : "")};
  job.can_be_stopped = true;
  job.alone = plan.study.measures.repeats > 0;
  return job;
}

SlurmJob collecting_job(const StudyPlan& plan, const std::string& after, const SpreadOptions& options) {
  SlurmJob job;
  job.name = "collect";
  job.about = "Pictures, tables and page of what is finished, however the runs have ended.";
  job.after = after;
  job.lines = {fmt::format("{} {} --collect", job_program, shell_line(study_words(plan, options)))};
  return job;
}

SlurmScript script_of(const StudyPlan& plan, std::size_t unfinished, const CommandWords& lists,
                      const SpreadOptions& options) {
  SlurmScript script;
  script.title = plan.study.file.stem().string();
  script.output = plan.folder;
  script.folders = {plan.folder / "runs"};
  script.threads = plan.threads;
  script.about = fmt::format("# {} of the {} runs of {} are unfinished: {} tasks, and what collects them.\n",
                             unfinished, plan.runs.size(), plan.study.file.string(), lists.size());
  if (!lists.empty()) script.jobs.push_back(runs_job(plan, lists, options));
  script.jobs.push_back(collecting_job(plan, lists.empty() ? "" : "afterany:runs", options));
  return script;
}

}  // namespace

void spread_study(const StudyPlan& plan, const std::vector<long>& unfinished, const SpreadOptions& options) {
  const std::size_t count = unfinished.size();
  if (options.commands) return print_commands(plan, lists_of(unfinished, std::max(1, options.chunk)), options);
  hand_over(script_of(plan, count, lists_of(unfinished, pieces_a_task(count, options.chunk, count)), options), options);
}

}  // namespace billow::cli
