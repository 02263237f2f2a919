// What is shown of a command's phases, and how their times add up.
#include "cli/run/progress.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

namespace billow::cli {
namespace {

constexpr unsigned long_after = 10;  // [s] the signal that says a phase ends the sleep

// What goes to stderr while `work` runs, with `style`.
template <class Work>
std::string shown(ProgressStyle style, const Work& work) {
  testing::internal::CaptureStderr();
  {
    Progress progress(style);
    work(progress);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, SaysNothingOfShortPhases) {
  const std::string text = shown(ProgressStyle::plain, [](Progress& progress) {
    progress.phase("reading", "a.obj");
    progress.phase("springs");
  });
  EXPECT_EQ(text, "");
}

TEST(Progress, SaysALongPhaseAndWhatItIsAtWorkOn) {
  const auto work = [](Progress& progress) {
    progress.phase("reading", "a.obj");
    sleep(long_after);
  };
  EXPECT_EQ(shown(ProgressStyle::plain, work), "reading a.obj ...\n");
  const nlohmann::json line = nlohmann::json::parse(shown(ProgressStyle::json, work));
  EXPECT_EQ(line, (nlohmann::json{{"phase", "reading"}, {"subject", "a.obj"}}));
}

TEST(Progress, AddsUpItsPhasesToTheWallClock) {
  using Clock = Progress::Clock;
  Progress progress(ProgressStyle::none, Clock::now() - std::chrono::seconds(2));
  progress.phase("reading", "a.obj");
  usleep(50'000);
  progress.phase("springs");
  progress.phase("reading", "b.obj");
  usleep(50'000);
  double sum = 0.0;
  std::vector<std::string> names;
  for (const auto& [name, seconds] : progress.phases()) sum += seconds, names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"start", "reading", "springs"}));
  EXPECT_GE(progress.seconds("start"), 2.0);
  EXPECT_GE(progress.seconds("reading"), 0.1);
  EXPECT_EQ(progress.seconds("survey"), 0.0);
  EXPECT_NEAR(sum, progress.wall(), 0.02 * progress.wall());
}

}  // namespace
}  // namespace billow::cli
