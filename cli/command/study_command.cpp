// billow study: runs that are missing, then the pictures, tables and page made of all of them.
#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <thread>

#include "base/atomic_file.h"
#include "base/claim.h"
#include "base/error.h"
#include "base/folder_lock.h"
#include "base/readable_number.h"
#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/run/frame_list.h"
#include "cli/run/interrupt.h"
#include "cli/run/output_folder.h"
#include "cli/study/study_page.h"
#include "cli/study/study_pictures.h"
#include "cli/study/study_plan.h"
#include "cli/study/study_run.h"
#include "cli/study/study_spread.h"
#include "cli/study/study_work.h"
#include "cli/text/terminal.h"
#include "render/gl/gl_context.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

void check_number(const StudyPlan& plan, const char* option, int number) {
  if (number > static_cast<int>(plan.runs.size()))
    throw InputError(fmt::format("{} {}: the study has runs 1 to {}", option, number, plan.runs.size()));
}

// A folder with other things in it is not written to.
void check_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error))
    throw OutputError(fmt::format("{} is not a folder; choose another with -o", folder.string()));
  const bool empty = fs::directory_iterator(folder, error) == fs::directory_iterator();
  if (!empty && !fs::exists(folder / study_files::record, error) && !fs::is_directory(folder / "runs", error))
    throw OutputError(
        fmt::format("{} already holds files that are not a study's; choose another folder with -o", folder.string()));
}

// The folder of the runs comes first: it marks the folder as a study's, also for another process that begins now.
void make_folders(const StudyPlan& plan) {
  check_folder(plan.folder);
  make_folder(plan.folder);
  make_folder_within(plan.folder, "runs");
  remove_strays(plan.folder);
}

std::vector<RunResult> results_of(const StudyPlan& plan) {
  std::vector<RunResult> results;
  for (const StudyRun& run : plan.runs) results.push_back(plan.result_of(run.number));
  return results;
}

int list_runs(const StudyPlan& plan) {
  for (const StudyRun& run : plan.runs) {
    const bool running = claim_holder(plan.claim_of(run.number)).has_value();
    const std::string_view status = running ? "running" : name(plan.result_of(run.number).status);
    print_line("{:>4}  {:<9} {}", run.number, status, label_of(plan.study, run));
  }
  return exit_done;
}

// In a process of its own, which run_jobs has started.
int perform(const StudyPlan& plan, int number) {
  catch_interrupts();
  const RunResult result =
      perform_run(plan.study, plan.run(number), plan.folder_of(number), {plan.threads, plan.resume, plan.backend});
  if (interrupted_by() != 0) return 128 + interrupted_by();
  say_line("{}: {}{}", plan.name_of(number), name(result.status), result.message.empty() ? "" : "; " + result.message);
  return exit_done;
}

int do_one(const StudyPlan& plan, int number) {
  do_runs(plan, {{number, result_stamp(plan.folder_of(number))}}, 1);
  if (interrupted_by() != 0) return 128 + interrupted_by();
  const RunResult result = plan.result_of(number);
  if (!result.message.empty()) say_line("{}", result.message);
  return is_finished(result) ? exit_done : exit_internal_fault;
}

// Of the runs `numbers`; `all`: the finished ones too.
std::vector<DueRun> due_runs(const StudyPlan& plan, const std::vector<long>& numbers, bool all) {
  std::vector<DueRun> due;
  for (const long given : numbers) {
    const int number = static_cast<int>(given);
    // Another process may write the result now: the stamp must not be younger than what is looked at.
    const ResultStamp before = result_stamp(plan.folder_of(number));
    const RunResult result = plan.result_of(number);
    if (result.status == RunStatus::missing && !result.message.empty())
      say_line("warning: {}: {}; it is done again", plan.name_of(number), result.message);
    if (all || !is_finished(result)) due.push_back({number, before});
  }
  return due;
}

// Runs that another process, told to overwrite, has begun anew since.
std::vector<DueRun> begun_anew(const StudyPlan& plan) {
  std::vector<DueRun> due;
  for (const StudyRun& run : plan.runs)
    if (plan.result_of(run.number).status == RunStatus::missing && claim_holder(plan.claim_of(run.number)))
      due.push_back({run.number, result_stamp(plan.folder_of(run.number))});
  return due;
}

int jobs_of(const StudyPlan& plan, const StudyOptions& options) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return options.jobs > 0 ? options.jobs : plan.study.measures.repeats > 0 ? 1 : cores;
}

void run_missing(const StudyPlan& plan, const std::vector<long>& numbers, const StudyOptions& options) {
  const std::vector<DueRun> due = due_runs(plan, numbers, options.overwrite);
  const int jobs = jobs_of(plan, options);
  say_line("{}: {} runs, {} of them finished already", plan.study.file.string(), numbers.size(),
           numbers.size() - due.size());
  do_runs(plan, due, jobs);
  for (auto others = begun_anew(plan); !others.empty() && interrupted_by() == 0; others = begun_anew(plan))
    do_runs(plan, others, jobs);
}

// Says which runs lack, the first few by name; their number.
std::size_t report_shortfalls(const StudyPlan& plan, const std::vector<RunResult>& results) {
  constexpr std::size_t most_named = 5;
  std::size_t lacking = 0;
  for (const StudyRun& run : plan.runs) {
    const RunResult& result = results[static_cast<std::size_t>(run.number) - 1];
    if (is_finished(result) || ++lacking > most_named) continue;
    say_line("{}: {}{}", plan.name_of(run.number), name(result.status),
             result.message.empty() ? "" : "; " + result.message);
  }
  if (lacking > most_named) say_line("and {} more; 'billow study … --list' names all", lacking - most_named);
  return lacking;
}

// A part of the study, for others to do the rest and somebody to assemble all.
int do_some(const StudyPlan& plan, const std::vector<long>& numbers, const StudyOptions& options) {
  do_runs(plan, due_runs(plan, numbers, options.overwrite), jobs_of(plan, options));
  if (interrupted_by() != 0) return 128 + interrupted_by();
  const bool whole = std::all_of(numbers.begin(), numbers.end(),
                                 [&](long number) { return is_finished(plan.result_of(static_cast<int>(number))); });
  return whole ? exit_done : exit_internal_fault;
}

int spread(const StudyPlan& plan, const std::vector<long>& numbers, const SpreadOptions& options) {
  check_folder(plan.folder);
  std::vector<long> unfinished;
  for (const DueRun& run : due_runs(plan, numbers, false)) unfinished.push_back(run.number);
  spread_study(plan, unfinished, options);
  return exit_done;
}

std::vector<long> chosen_runs(const StudyPlan& plan, const StudyOptions& options) {
  const auto total = static_cast<long>(plan.runs.size());
  if (options.only) return {*options.only};
  return numbers_in(options.some.empty() ? std::vector<FrameSpan>{FrameSpan{}} : options.some, total, "--runs",
                    "the study has runs");
}

// By one process at a time, so that all files are of the same results; who comes last has them all.
int assemble(const StudyPlan& plan) {
  const FolderLock lock(plan.folder);
  const std::vector<RunResult> results = results_of(plan);
  StudyContents contents{plan.study, plan.folder, plan.runs, results, {}};
  contents.faults = make_pictures(contents);
  for (const auto& [picture, fault] : contents.faults)
    say_line("warning: the picture '{}' is missing: {}", picture, fault);
  write_file_atomically(plan.folder / study_files::table, results_csv(plan.study, plan.runs, results));
  write_file_atomically(plan.folder / study_files::record, study_json(plan.study, plan.runs, results));
  write_file_atomically(plan.folder / study_files::page, study_page(contents));
  // Of a process that was killed when its run was done already, and that nobody had to take over.
  for (const StudyRun& run : plan.runs) remove_dead_claim(plan.claim_of(run.number));
  const std::size_t lacking = report_shortfalls(plan, results);
  say_line(
      "wrote {}, results.csv, study.json and index.html to {}{}",
      counted(static_cast<long>(plan.study.pictures.size() - contents.faults.size()), "picture"), plan.folder.string(),
      lacking ? fmt::format("; {} missing or failed", counted(static_cast<long>(lacking), "run is", "runs are")) : "");
  return lacking || !contents.faults.empty() ? exit_internal_fault : exit_done;
}

}  // namespace

int study_command(const StudyOptions& options) {
  StudyPlan plan = make_plan(options.study, options.output);
  plan.untrusted = options.untrusted;
  plan.backend = options.backend;
  plan.threads = options.threads, plan.resume = options.resume;
  if (options.perform) {
    check_number(plan, "--perform", *options.perform);
    return perform(plan, *options.perform);
  }
  if (options.only) check_number(plan, "--only", *options.only);
  const std::vector<long> numbers = chosen_runs(plan, options);
  // A fault in the last run's scene is found before the first one starts.
  for (const long number : numbers) read_hash(plan, static_cast<int>(number));
  check_pictures(plan);
  if (options.list) return list_runs(plan);
  if (options.spread.any()) return spread(plan, numbers, options.spread);
  if (!options.collect && plan.study.measures.render) render::GlContext(plan.backend);  // before every run fails by it
  catch_interrupts();
  make_folders(plan);
  if (options.only) return do_one(plan, *options.only);
  if (!options.some.empty()) return do_some(plan, numbers, options);
  if (!options.collect) run_missing(plan, numbers, options);
  return interrupted_by() != 0 ? 128 + interrupted_by() : assemble(plan);
}

}  // namespace billow::cli
