// Other programs: what they say, and where they work.
#include "base/child_process.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/mesh_files.h"

namespace billow {
namespace {

TEST(RunProgram, GivesBackAllThatWasWritten) {
  const ProgramResult result = run_program({"sh", "-c", "cat; head -c 100000 /dev/zero; echo wrong >&2"}, "in", 60.0);
  EXPECT_EQ(result.output, "in" + std::string(100'000, '\0'));
  EXPECT_EQ(result.errors, "wrong\n");
}

TEST(RunProgram, WorksInTheFolderThatIsGiven) {
  const test::TemporaryFolder folder;
  const ProgramResult result = run_program({"pwd", "-P"}, "", 60.0, {}, folder.path());
  EXPECT_EQ(result.output, std::filesystem::canonical(folder.path()).string() + "\n");
}

}  // namespace
}  // namespace billow
