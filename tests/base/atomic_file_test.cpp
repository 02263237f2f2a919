// How far a file goes before it has its name. What else holds of it is shown where PNG files are written.
#include "base/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>

#include "base/error.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace {

std::filesystem::path named;  // the file whose name must not be there yet
int waits = 0;                // for the disk
int failing = 0;              // errno of every further wait; 0: none

}  // namespace

// In the place of the C library's, for the whole test program: a disk that can be watched.
extern "C" int fsync(int) {
  ++waits;
  EXPECT_FALSE(std::filesystem::exists(named));
  errno = failing;
  return failing == 0 ? 0 : -1;
}

namespace billow {
namespace {

TEST(AtomicFile, WaitsForTheDiskWhereItIsAskedTo) {
  const test::TemporaryFolder folder;
  write_file_atomically(folder.path() / "a", "a");
  settle_names(folder.path());
  EXPECT_EQ(waits, 0);

  write_durably();
  named = folder.path() / "b";
  write_file_atomically(named, "b");
  EXPECT_EQ(waits, 1);
  EXPECT_EQ(test::read_text(named), "b");

  named.clear();
  std::filesystem::create_directories(folder.path() / "c/d");
  settle_names(folder.path());
  EXPECT_EQ(waits, 4);  // for it and the two below

  failing = EIO;
  try {
    write_file_atomically(folder.path() / "a", "other");
    ADD_FAILURE() << "a disk that failed went unnoticed";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/a: Input/output error"));
  }
  EXPECT_EQ(test::read_text(folder.path() / "a"), "a");
  EXPECT_THROW(settle_names(folder.path()), OutputError);
  failing = 0;
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  return names;
}

// What a killed process leaves, by the name of the file that it was writing.
void leave_stray(const std::filesystem::path& target) {
  const pid_t child = fork();
  if (child == 0) {
    const AtomicFile file(target);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

TEST(RemoveStrays, RemovesThoseOfProcessesThatAreGone) {
  const test::TemporaryFolder folder;
  leave_stray(folder.path() / "frame.png");
  leave_stray(folder.path() / "frame.png");
  ASSERT_EQ(names_in(folder.path()).size(), 2u);
  EXPECT_TRUE(is_temporary_name(names_in(folder.path())[0]));
  remove_strays(folder.path());
  EXPECT_THAT(names_in(folder.path()), testing::IsEmpty());
  remove_strays(folder.path() / "missing");
}

TEST(RemoveStrays, LeavesThoseOfRunningProcesses) {
  const test::TemporaryFolder folder;
  AtomicFile own(folder.path() / "own");
  int told[2], done[2];
  ASSERT_EQ(pipe(told) + pipe(done), 0);
  const pid_t child = fork();
  if (child == 0) {
    AtomicFile file(folder.path() / "other");
    char byte = 0;
    const bool waited = write(told[1], &byte, 1) == 1 && read(done[0], &byte, 1) == 1;
    file.commit();
    _exit(waited ? 0 : 1);
  }
  char byte = 0;
  ASSERT_EQ(read(told[0], &byte, 1), 1);
  remove_strays(folder.path());
  ASSERT_EQ(write(done[1], &byte, 1), 1);
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  own.commit();
  EXPECT_THAT(names_in(folder.path()), testing::UnorderedElementsAre("own", "other"));
  for (const int end : {told[0], told[1], done[0], done[1]}) close(end);
}

// Of another machine nobody can tell which processes run: by the age of what they wrote last.
TEST(RemoveStrays, TakesThoseOfOtherMachinesForGoneAfterADay) {
  const test::TemporaryFolder folder;
  const auto fresh = folder.write(".a.png.00000000-1-0.part", ""), old = folder.write(".b.png.00000000-1-1.part", "");
  const auto now = std::filesystem::file_time_type::clock::now();
  std::filesystem::last_write_time(old, now - std::chrono::hours(25));
  remove_strays(folder.path());
  EXPECT_THAT(names_in(folder.path()), testing::ElementsAre(".a.png.00000000-1-0.part"));
}

TEST(RemoveStrays, LeavesEverythingElse) {
  const test::TemporaryFolder folder;
  const std::vector<std::string> others = {"film.part", ".film.part", ".film.12345678.part", ".film.1234567g-1-0.part",
                                           ".film.12345678-1-0.part.png"};
  for (const std::string& name : others) {
    const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::hours(25);
    std::filesystem::last_write_time(folder.write(name, ""), old);
    EXPECT_FALSE(is_temporary_name(name)) << name;
  }
  remove_strays(folder.path());
  EXPECT_THAT(names_in(folder.path()), testing::UnorderedElementsAreArray(others));
}

}  // namespace
}  // namespace billow
