// What is left of a process that went at once.
#include "base/sudden_end.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "base/atomic_file.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

using test::read_text;

// Runs `work` in a process of its own, which then goes without a word.
void in_child(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(SuddenEnd, RemovesFilesThatAreHalfWritten) {
  const test::TemporaryFolder folder;
  in_child([&] {
    write_file_atomically(folder.path() / "whole", "whole");
    AtomicFile half(folder.path() / "half"), other(folder.path() / "other");
    half.append("ha");
    tidy_up(SuddenEnd::failure);
    _exit(0);
  });
  EXPECT_EQ(read_text(folder.path() / "whole"), "whole");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(SuddenEnd, LeavesTheFilesOfItsParentAlone) {
  const test::TemporaryFolder folder;
  AtomicFile file(folder.path() / "file");
  in_child([&] { tidy_up(SuddenEnd::failure); });
  file.append("whole");
  file.commit();
  EXPECT_EQ(read_text(folder.path() / "file"), "whole");
}

TEST(SuddenEnd, OpensNothingAfterwards) {
  const test::TemporaryFolder folder;
  in_child([&] {
    tidy_up(SuddenEnd::failure);
    alarm(1);
    signal(SIGALRM, [](int) { _exit(0); });
    const AtomicFile file(folder.path() / "file");
    _exit(1);
  });
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(StandingMark, IsWrittenOverWhatStands) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("record", "is running now");
  const auto marked = [&](SuddenEnd why) {
    in_child([&] {
      const StandingMark mark(file, 3, "running", "failed ", "stopped");
      tidy_up(why);
    });
    return read_text(file);
  };
  EXPECT_EQ(marked(SuddenEnd::failure), "is failed  now");
  EXPECT_EQ(marked(SuddenEnd::interruption), "is failed  now");  // something else stands there
  folder.write("record", "is running now");
  EXPECT_EQ(marked(SuddenEnd::interruption), "is stopped now");
}

TEST(StandingMark, IsGoneWithItsOwner) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("record", "running");
  { const StandingMark mark(file, 0, "running", "failed ", "stopped"); }
  EXPECT_FALSE(mark(SuddenEnd::failure));
  EXPECT_EQ(read_text(file), "running");
}

TEST(StandingMark, OfAFileThatIsGoneIsNoFault) {
  const test::TemporaryFolder folder;
  const StandingMark of_nothing(folder.path() / "record", 0, "running", "failed ", "stopped");
  EXPECT_FALSE(mark(SuddenEnd::failure));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace billow
