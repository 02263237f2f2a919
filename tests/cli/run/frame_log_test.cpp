#include "cli/run/frame_log.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/error.h"
#include "tests/support/mesh_files.h"

namespace billow::cli {
namespace {

FrameRecord record(long frame) {
  const double t = static_cast<double>(frame) / 3.0;
  return {frame, t, 2.0 * t, -t, {t, 0.1, 1e-300}, {-t, 1e300, 7.0}, {0.1 * t, -1e-9}, 3 * frame};
}

TEST(FrameLog, GivesBackExactlyWhatWasAddedAndLeavesNoFile) {
  const test::TemporaryFolder folder;
  FrameLog log(folder.path() / "run.json");
  for (long f = 5; f < 105; ++f) log.add(record(f));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  const FrameLog moved = std::move(log);
  EXPECT_EQ(moved.size(), 100);
  long next = 5;
  for (const FrameRecord& got : moved) {
    const FrameRecord wanted = record(next++);
    EXPECT_EQ(got.frame, wanted.frame);
    EXPECT_EQ(got.time, wanted.time);
    EXPECT_EQ(got.kinetic, wanted.kinetic);
    EXPECT_EQ(got.potential, wanted.potential);
    EXPECT_EQ(got.linear_momentum, wanted.linear_momentum);
    EXPECT_EQ(got.angular_momentum, wanted.angular_momentum);
    EXPECT_EQ(got.stretch.largest, wanted.stretch.largest);
    EXPECT_EQ(got.stretch.mean, wanted.stretch.mean);
    EXPECT_EQ(got.touching, wanted.touching);
  }
  EXPECT_EQ(next, 105);
}

TEST(FrameLog, RefusesAFolderThatIsNotThere) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(FrameLog(folder.path() / "absent" / "run.json"), OutputError);
}

}  // namespace
}  // namespace billow::cli
