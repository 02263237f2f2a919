// How far a file goes before it has its name. What else holds of it is shown where PNG files are written.
#include "base/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

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

}  // namespace
}  // namespace billow
