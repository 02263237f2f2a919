// Claims, children, and results between them.
#include "cli/study/study_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <tuple>

#include "base/atomic_file.h"
#include "base/claim.h"
#include "base/error.h"
#include "cli/run/output_folder.h"
#include "cli/run/progress.h"
#include "cli/study/study_jobs.h"
#include "cli/study/study_run.h"
#include "cli/text/terminal.h"

namespace billow::cli {

namespace {

std::string described(const ClaimHolder& holder) {
  if (holder.host.empty()) return "another process";
  return fmt::format("process {} on {}, since {}", holder.process, holder.host, holder.since);
}

/// The runs of one process among several.
class SharedRuns : public JobKeeper {
 public:
  SharedRuns(const StudyPlan& plan, const std::vector<DueRun>& due) : plan_(plan), total_(due.size()) {
    for (const DueRun& run : due) before_[run.number] = run.before;
  }

  Turn turn_of(int number) override {
    make_folder_within(plan_.folder, run_folder("", plan_.study, plan_.run(number)));
    std::variant<Claim, ClaimHolder> taken = take_claim(plan_.claim_of(number));
    if (const auto* holder = std::get_if<ClaimHolder>(&taken)) {
      holder_.insert_or_assign(number, *holder);
      return Turn::later;
    }
    // What another process has done since this one began is not done again, not even when it has failed.
    const bool is_new = result_stamp(plan_.folder_of(number)) != before_[number];
    if (is_new && plan_.result_of(number).status != RunStatus::missing) {
      report(number, "by another process");
      return Turn::past;
    }
    claim_.insert_or_assign(number, std::move(std::get<Claim>(taken)));
    remove_strays(plan_.folder_of(number));
    remove_result(plan_.folder_of(number));
    return Turn::now;
  }

  JobCommand command_of(int number) override {
    std::vector<std::string> words = {
        "billow", "study", plan_.study.file.string(), "-o", plan_.folder.string(), "--perform", std::to_string(number)};
    words.insert(words.end(), {"--backend", text_of(plan_.backend)});
    if (plan_.untrusted) words.push_back("--untrusted");
    if (plan_.threads > 0) words.insert(words.end(), {"--threads", std::to_string(plan_.threads)});
    if (plan_.resume) words.push_back("--resume");
    return {words, plan_.log_of(number)};
  }

  bool goes_on(int number) override {
    if (claim_.at(number).renew()) return true;
    claim_.erase(number);
    return false;
  }

  void ended(const JobEnd& end) override {
    if (plan_.result_of(end.number).status == RunStatus::missing) write_failure(end);
    report(end.number, fmt::format("in {:.1f} s", end.seconds));
    claim_.erase(end.number);
  }

  void waits(const std::vector<int>& others) override {
    for (const int number : others) {
      const auto holder = holder_.find(number);
      if (holder != holder_.end() && said_.emplace(number, holder->second.host, holder->second.process).second)
        say_waiting(number, holder->second);
    }
  }

 private:
  void write_failure(const JobEnd& end) const {
    RunResult result;
    result.status = RunStatus::failed;
    result.hash = plan_.hash[static_cast<std::size_t>(end.number) - 1];
    result.command = command_line_of(end.number);
    result.message = fmt::format("{}: {}", described_end(end.status), last_words(plan_.log_of(end.number)));
    write_result(plan_.folder_of(end.number), result);
  }
  std::string command_line_of(int number) const { return cli::command_of(plan_.study, plan_.run(number)); }

  void report(int number, const std::string& how) {
    const std::string status(name(plan_.result_of(number).status));
    say_ended({"runs", ++ended_, total_, plan_.name_of(number), status, how});
  }

  void say_waiting(int number, const ClaimHolder& holder) const {
    say_line("waiting for {}: {} is at it", plan_.name_of(number), described(holder));
    if (!holder.is_near)
      say_line(
          "  if that machine is gone, the run is taken over {} s after its last sign of life; at once when you remove "
          "{}",
          Claim::dead_after.count(), plan_.claim_of(number).string());
  }

  const StudyPlan& plan_;
  std::size_t total_, ended_ = 0;
  std::map<int, ResultStamp> before_;
  std::map<int, Claim> claim_;         // on what this process is at
  std::map<int, ClaimHolder> holder_;  // of what others are at
  std::set<std::tuple<int, std::string, long>> said_;
};

}  // namespace

void do_runs(const StudyPlan& plan, const std::vector<DueRun>& due, int jobs) {
  SharedRuns runs(plan, due);
  std::vector<int> numbers;
  for (const DueRun& run : due) numbers.push_back(run.number);
  // A run that will be gone on with may draw its frame to the end and write down how far it has come.
  constexpr std::chrono::seconds short_grace{2}, long_grace{60};
  run_jobs(numbers, jobs, plan.resume ? long_grace : short_grace, runs);
}

}  // namespace billow::cli
