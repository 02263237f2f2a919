// billow bench: runs every section and prints nanoseconds per spring, then each target beside its measurement.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/sections.h"

namespace billow::bench {

namespace {

/// Keeps every repetition's nanoseconds per spring. Repetitions are interleaved at random, so that whatever else the
/// machine does falls on all benchmarks alike, and medians are taken. One thread's work is told by the processor time
/// that it used, which other processes cannot lengthen; what two threads gain, by the clock.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const auto springs = run.counters.find("springs");
      if (run.run_type != Run::RT_Iteration || springs == run.counters.end()) continue;
      const double share = 1e9 / static_cast<double>(run.iterations) / springs->second.value;
      Times& times = times_[run.run_name.function_name];
      times.processor.push_back(share * run.cpu_accumulated_time);
      times.clock.push_back(share * run.real_accumulated_time);
    }
  }

  /// Median; not a number for a benchmark that did not run.
  double nanoseconds(const std::string& name, bool by_clock) const {
    const auto found = times_.find(name);
    if (found == times_.end()) return NAN;
    std::vector<double> sorted = by_clock ? found->second.clock : found->second.processor;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }

  void print() const {
    fmt::print("{:<36} {:>10} {:>10}\n", "ns per spring, median", "processor", "clock");
    for (const auto& [name, times] : times_)
      fmt::print("{:<36} {:>10.3f} {:>10.3f}\n", name, nanoseconds(name, false), nanoseconds(name, true));
  }

 private:
  struct Times {
    std::vector<double> processor, clock;
  };
  std::map<std::string, Times> times_;
};

void print_targets(const Targets& targets, const Collector& results) {
  fmt::print("\n{:<52} {:>8} {:>9}\n", "ratio", "target", "measured");
  for (const Target& target : targets) {
    const double ratio = results.nanoseconds(target.measured, target.by_clock) /
                         results.nanoseconds(target.compared_to, target.by_clock);
    if (std::isnan(ratio)) continue;
    const bool met = target.at_least ? ratio >= target.limit : ratio <= target.limit;
    fmt::print("{:<52} {:>2} {:>5.2f} {:>9.2f}  {}\n", target.what, target.at_least ? ">=" : "<=", target.limit, ratio,
               met ? "met" : "MISSED");
  }
}

int run(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  const auto json = std::find(words.begin(), words.end(), "--json");
  const bool as_json = json != words.end();
  if (as_json) *json = "--benchmark_format=json";
  // What follows on the command line comes later and wins.
  words.insert(words.begin() + 1, {"--benchmark_repetitions=9", "--benchmark_min_time=0.05",
                                   "--benchmark_enable_random_interleaving=true"});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());

  Targets targets = add_ceiling();
  const auto append = [&](const Targets& more) { targets.insert(targets.end(), more.begin(), more.end()); };
  append(add_passes());
#ifdef BILLOW_BENCH_BULLET
  append(add_bullet());
#endif
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  if (as_json) return benchmark::RunSpecifiedBenchmarks(), 0;
  Collector results;
  benchmark::RunSpecifiedBenchmarks(&results);
  results.print();
  print_targets(targets, results);
  return 0;
}

}  // namespace

}  // namespace billow::bench

int main(int argc, char** argv) { return billow::bench::run(argc, argv); }
