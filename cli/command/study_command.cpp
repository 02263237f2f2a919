// billow study: runs that are missing, then the pictures, tables and page made of all of them.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <thread>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/run/interrupt.h"
#include "cli/run/output_folder.h"
#include "cli/study/study.h"
#include "cli/study/study_jobs.h"
#include "cli/study/study_page.h"
#include "cli/study/study_pictures.h"
#include "cli/study/study_results.h"
#include "cli/study/study_run.h"
#include "cli/text/terminal.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

/// A study with its runs, and what each of them must be to count.
struct Plan {
  Study study;
  fs::path folder;
  std::vector<StudyRun> runs;
  std::vector<std::string> hash;  // per run

  fs::path folder_within(const StudyRun& run) const { return run_folder("", study, run); }
  fs::path folder_of(const StudyRun& run) const { return folder / folder_within(run); }
  fs::path log_of(int number) const { return folder_of(runs[number - 1]) / "log.txt"; }
  RunResult result_of(const StudyRun& run) const { return read_result(folder_of(run), hash[run.number - 1]); }
};

Plan make_plan(const StudyOptions& options) {
  Plan plan{read_study(options.study), options.output, {}, {}};
  if (plan.folder.empty()) plan.folder = fs::path("out") / options.study.stem();
  plan.runs = runs_of(plan.study);
  return plan;
}

// Reads every run's scene, so that a fault in the last one is found before the first one starts.
void find_hashes(Plan& plan) {
  for (const StudyRun& run : plan.runs)
    plan.hash.push_back(run_hash(plan.study, read_scene(plan.study.scene, overrides_of(plan.study, run))));
}

bool is_finished(const RunResult& result) {
  return result.status == RunStatus::done || result.status == RunStatus::diverged;
}

const StudyRun& run_numbered(const Plan& plan, int number) {
  if (number > static_cast<int>(plan.runs.size()))
    throw InputError(fmt::format("--only {}: the study has runs 1 to {}", number, plan.runs.size()));
  return plan.runs[number - 1];
}

// A folder with other things in it is not written to.
void check_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error))
    throw OutputError(fmt::format("{} is not a folder; choose another with -o", folder.string()));
  const bool empty = fs::directory_iterator(folder, error) == fs::directory_iterator();
  if (!empty && !fs::exists(folder / "study.json", error) && !fs::is_directory(folder / "runs", error))
    throw OutputError(
        fmt::format("{} already holds files that are not a study's; choose another folder with -o", folder.string()));
}

std::vector<RunResult> results_of(const Plan& plan) {
  std::vector<RunResult> results;
  for (const StudyRun& run : plan.runs) results.push_back(plan.result_of(run));
  return results;
}

int list_runs(const Plan& plan) {
  for (const StudyRun& run : plan.runs)
    print_line("{:>4}  {:<9} {}", run.number, name(plan.result_of(run).status), label_of(plan.study, run));
  return exit_done;
}

int do_one(const Plan& plan, int number) {
  const StudyRun& run = run_numbered(plan, number);
  check_folder(plan.folder);
  catch_interrupts();
  make_folder(plan.folder);
  make_folder_within(plan.folder, plan.folder_within(run));
  const RunResult result = perform_run(plan.study, run, plan.folder_of(run));
  if (interrupted_by() != 0) return 128 + interrupted_by();
  say_line("run {}, {}: {}{}", number, label_of(plan.study, run), name(result.status),
           result.message.empty() ? "" : "; " + result.message);
  return exit_done;
}

// The last line that a run left in its log: what it died of.
std::string last_words(const fs::path& log) {
  std::ifstream file(log);
  std::string line, last = "it left no message";
  while (std::getline(file, line))
    if (!line.empty()) last = line;
  return last;
}

std::vector<int> unfinished(const Plan& plan, bool all) {
  std::vector<int> numbers;
  for (const StudyRun& run : plan.runs)
    if (all || !is_finished(plan.result_of(run))) numbers.push_back(run.number);
  return numbers;
}

// A run without a result of its own has failed; that is written down for --collect.
void settle(const Plan& plan, const JobEnd& end) {
  const StudyRun& run = plan.runs[end.number - 1];
  if (end.status == 0 || interrupted_by() != 0) return;
  RunResult result;
  result.status = RunStatus::failed;
  result.hash = plan.hash[end.number - 1];
  result.command = command_of(plan.study, run);
  result.message = fmt::format("exit status {}: {}", end.status, last_words(plan.log_of(end.number)));
  write_result(plan.folder_of(run), result);
}

void run_missing(const Plan& plan, const StudyOptions& options) {
  const std::vector<int> numbers = unfinished(plan, options.overwrite);
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int jobs = options.jobs > 0 ? options.jobs : plan.study.measures.repeats > 0 ? 1 : cores;
  for (const int number : numbers) {
    make_folder_within(plan.folder, plan.folder_within(plan.runs[number - 1]));
    std::error_code error;
    fs::remove(plan.folder_of(plan.runs[number - 1]) / "result.json", error);
  }
  say_line("{}: {} runs, {} of them finished already", plan.study.file.string(), plan.runs.size(),
           plan.runs.size() - numbers.size());
  std::size_t ended = 0;
  std::vector<std::string> command = {"billow", "study", plan.study.file.string(), "-o", plan.folder.string()};
  if (options.untrusted) command.push_back("--untrusted");
  run_jobs(
      command, numbers, jobs, [&](int number) { return plan.log_of(number); },
      [&](const JobEnd& end) {
        settle(plan, end);
        const StudyRun& run = plan.runs[end.number - 1];
        say_line("[{}/{}] run {}, {}: {} in {:.1f} s", ++ended, numbers.size(), end.number, label_of(plan.study, run),
                 name(plan.result_of(run).status), end.seconds);
      });
}

int assemble(const Plan& plan) {
  const std::vector<RunResult> results = results_of(plan);
  StudyContents contents{plan.study, plan.folder, plan.runs, results, {}};
  contents.faults = make_pictures(contents);
  for (const auto& [picture, fault] : contents.faults)
    say_line("warning: the picture '{}' is missing: {}", picture, fault);
  write_file_atomically(plan.folder / "results.csv", results_csv(plan.study, plan.runs, results));
  write_file_atomically(plan.folder / "study.json", study_json(plan.study, plan.runs, results));
  write_file_atomically(plan.folder / "index.html", study_page(contents));
  const auto failed = std::count_if(results.begin(), results.end(), [](const RunResult& r) {
    return r.status == RunStatus::failed || r.status == RunStatus::missing;
  });
  say_line("wrote {} pictures, results.csv, study.json and index.html to {}{}",
           plan.study.pictures.size() - contents.faults.size(), plan.folder.string(),
           failed ? fmt::format("; {} runs are missing or failed", failed) : "");
  return failed || !contents.faults.empty() ? exit_internal_fault : exit_done;
}

}  // namespace

int study_command(const StudyOptions& options) {
  Plan plan = make_plan(options);
  if (options.only) return do_one(plan, *options.only);
  find_hashes(plan);
  if (options.list) return list_runs(plan);
  check_folder(plan.folder);
  catch_interrupts();
  make_folder(plan.folder);
  if (!options.collect) {
    // Marks the folder as a study's, should this be cut short.
    write_file_atomically(plan.folder / "study.json", study_json(plan.study, plan.runs, results_of(plan)));
    run_missing(plan, options);
    if (interrupted_by() != 0) return 128 + interrupted_by();
  }
  return assemble(plan);
}

}  // namespace billow::cli
