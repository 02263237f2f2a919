// Where memory or a thread is not to be had, the process ends with a word, whoever asked.
#include "base/out_of_memory.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <new>
#include <thread>

namespace billow {
namespace {

#ifndef BILLOW_SANITIZE  // which have allocators of their own

constexpr std::size_t too_much = std::size_t{1} << 60;

// Keeps the compiler from leaving out an allocation that nobody uses.
void use(const volatile void* memory) { EXPECT_FALSE(memory); }

const auto ends = testing::ExitedWithCode(1);

TEST(OutOfMemoryDeathTest, EndsTheProcessWithAWord) {
  EXPECT_EXIT(use(std::malloc(too_much)), ends, "^out of memory\n$");
  EXPECT_EXIT(use(std::calloc(too_much / 8, 8)), ends, "^out of memory\n$");
  EXPECT_EXIT(use(std::realloc(std::malloc(8), too_much)), ends, "^out of memory\n$");
  EXPECT_EXIT(use(std::aligned_alloc(64, too_much)), ends, "^out of memory\n$");
  EXPECT_EXIT(use(::operator new(too_much)), ends, "^out of memory\n$");
  EXPECT_EXIT(use(::operator new(too_much, std::nothrow)), ends, "^out of memory\n$");
  EXPECT_EXIT(use(mmap(nullptr, too_much, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)), ends, "^out of memory\n$");
  void* memory = nullptr;
  EXPECT_EXIT(EXPECT_EQ(posix_memalign(&memory, 64, too_much), 0), ends, "^out of memory\n$");
}

TEST(OutOfMemoryDeathTest, CountsAThreadThatCannotBeStarted) {
  const auto start = [] {
    rlimit limit{};
    getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur = 1 << 20;  // less than it has
    setrlimit(RLIMIT_AS, &limit);
    std::thread([] {}).join();
  };
  EXPECT_EXIT(start(), ends, "^no thread can be started: out of memory, or too many of them\n$");
}

TEST(OutOfMemoryDeathTest, CallsWhatItIsGivenInstead) {
  const auto ask = [] {
    set_out_of_memory_action([](const char*, std::size_t bytes) { _exit(bytes == too_much ? 7 : 8); });
    use(std::malloc(too_much));
  };
  EXPECT_EXIT(ask(), testing::ExitedWithCode(7), "");
}

TEST(OutOfMemory, LeavesEveryOtherAnswerAlone) {
  void* memory = nullptr;
  EXPECT_EQ(posix_memalign(&memory, 3, 8), EINVAL);
  ASSERT_EQ(posix_memalign(&memory, 4096, 8), 0);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % 4096, 0u);
  std::free(memory);
  std::free(std::realloc(std::malloc(8), 0));  // may give nothing, and that is no fault
  EXPECT_EQ(mmap(nullptr, 0, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0), MAP_FAILED);
}

#endif

}  // namespace
}  // namespace billow
