// What happens in the child stays in the child, and the parent learns why.
#include "base/limited_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "base/error.h"
#include "base/out_of_memory.h"

namespace billow::sim {
namespace {

using testing::HasSubstr;

constexpr ProcessLimits limits = {
    .memory_bytes = 64 << 20, .cpu_seconds = 1, .wall_seconds = 60.0, .reply_bytes = 1 << 20};

std::string refusal(const std::function<std::string()>& work, const ProcessLimits& given = limits) {
  try {
    reply_of_child(work, given);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

[[noreturn]] std::string spin() {
  volatile unsigned k = 0;
  for (;;) k = k + 1;
}

TEST(LimitedProcess, GivesTheReplyBack) {
  EXPECT_EQ(reply_of_child([] { return std::string("reply"); }, limits), "reply");
  EXPECT_EQ(reply_of_child([] { return std::string(); }, limits), "");
  EXPECT_EQ(reply_of_child([] { return std::string(1 << 20, 'x'); }, limits).size(), std::size_t{1} << 20);
}

TEST(LimitedProcess, PassesOnWhatTheWorkThrew) {
  EXPECT_EQ(refusal([]() -> std::string { throw InputError("line 3: bad"); }), "line 3: bad");
  EXPECT_EQ(refusal([]() -> std::string { throw std::runtime_error("worse"); }), "worse");
}

TEST(LimitedProcess, OutlivesACrash) {
  EXPECT_THAT(refusal([]() -> std::string {
                raise(SIGUSR2);  // sanitizers catch the usual ones
                return "";
              }),
              HasSubstr("crashed on it (SIGUSR2)"));
  EXPECT_THAT(refusal([]() -> std::string { _exit(7); }), HasSubstr("stopped on it"));
}

TEST(LimitedProcess, EndsAHang) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(refusal(
                  []() -> std::string {
                    pause();
                    return "";
                  },
                  {.memory_bytes = 64 << 20, .wall_seconds = 0.2}),
              HasSubstr("longer than 0.2 s"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

TEST(LimitedProcess, EndsEndlessWork) { EXPECT_THAT(refusal(spin), HasSubstr("1 s of processor time")); }

TEST(LimitedProcess, EndsGreed) {
#ifdef BILLOW_SANITIZE
  GTEST_SKIP() << "sanitizers need the address space";
#endif
  EXPECT_EQ(refusal([] { return std::string(std::size_t{1} << 30, 'x'); }),
            "it needs more than 64 MiB of memory; the file is broken or too large");
}

// What the limits grant and the machine has not is no fault of the file.
TEST(LimitedProcess, KnowsItsOwnLimitFromTheMachines) {
#ifdef BILLOW_SANITIZE
  GTEST_SKIP() << "sanitizers need the address space";
#endif
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  rlimit tight = before;
  tight.rlim_cur = std::size_t{4} << 30;
  ASSERT_EQ(setrlimit(RLIMIT_AS, &tight), 0);
  const ProcessLimits generous = {
      .memory_bytes = std::size_t{64} << 30, .cpu_seconds = 1, .wall_seconds = 60.0, .reply_bytes = 1 << 20};
  EXPECT_THROW(reply_of_child([] { return std::string(std::size_t{8} << 30, 'x'); }, generous), ResourceError);
  setrlimit(RLIMIT_AS, &before);
}

TEST(LimitedProcess, RefusesAReplyOverTheLimit) {
  EXPECT_THAT(refusal([] { return std::string((1 << 20) + 1, 'x'); }), HasSubstr("more than the limit"));
}

TEST(LimitedProcess, KeepsTheChildSilent) {
  testing::internal::CaptureStderr();
  reply_of_child(
      [] {
        std::fputs("noise", stderr);
        std::fflush(stderr);
        return std::string();
      },
      limits);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(LimitedProcess, LeavesNoZombie) {
  refusal([]() -> std::string { abort(); });
  refusal(
      []() -> std::string {
        pause();
        return "";
      },
      {.memory_bytes = 64 << 20, .wall_seconds = 0.01});
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace billow::sim
