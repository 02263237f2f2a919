// Lines that are said of what takes long, and of nothing else.
#include "base/announcement.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/process_start.h"

namespace billow {
namespace {

constexpr double soon = 0.02;        // [s]
constexpr unsigned long_after = 10;  // [s] a signal ends the sleep

TEST(Announcement, IsWrittenWhenItsTimeHasCome) {
  testing::internal::CaptureStderr();
  announce_later("still reading\n", soon);
  sleep(long_after);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "still reading\n");
}

TEST(Announcement, IsNotWrittenWhenWithdrawnOrReplaced) {
  testing::internal::CaptureStderr();
  announce_later("reading\n", soon);
  withdraw_announcement();
  usleep(static_cast<useconds_t>(3e6 * soon));
  announce_later("springs\n", soon);
  announce_later("limit\n", soon);
  sleep(long_after);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "limit\n");
}

TEST(ProcessStart, LiesBeforeNowAndStays) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point first = process_start();
  EXPECT_LE(first, Clock::now());
  sleep(1);
  EXPECT_LT(std::chrono::abs(process_start() - first), std::chrono::milliseconds(1));
}

}  // namespace
}  // namespace billow
