// Reading what is a file, and refusing the rest at once.
#include "base/regular_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "base/error.h"
#include "tests/support/mesh_files.h"

namespace billow {
namespace {

namespace fs = std::filesystem;

class RegularFile : public testing::Test {
 protected:
  void expect_refused(const fs::path& file, const std::string& reason) {
    EXPECT_THAT([&] { read_regular_file(file); }, testing::ThrowsMessage<InputError>(file.string() + ": " + reason));
    EXPECT_THROW(read_tail(file, 10), InputError);
  }

  const test::TemporaryFolder folder_;
  const fs::path file_ = folder_.path() / "file";
};

TEST_F(RegularFile, IsReadWholeOrFromItsEnd) {
  const std::string bytes = std::string("a\0b\xff", 4) + std::string(200'000, 'x') + "end";
  std::ofstream(file_, std::ios::binary) << bytes;
  EXPECT_EQ(read_regular_file(file_), bytes);
  EXPECT_EQ(read_regular_file(file_, bytes.size()), bytes);
  EXPECT_EQ(read_tail(file_, 5), "xxend");
  EXPECT_EQ(read_tail(file_, bytes.size() + 1), bytes);
}

TEST_F(RegularFile, IsRefusedWhenItIsTooLarge) {
  std::ofstream(file_) << std::string(2049, 'x');
  EXPECT_THAT([&] { read_regular_file(file_, 2048, "; give less"); },
              testing::ThrowsMessage<InputError>(file_.string() + ": larger than 2 KiB; give less"));
}

// Opening a pipe would wait for a writer.
TEST_F(RegularFile, IsNoFolderNorPipeNorDevice) {
  expect_refused(file_, "no such file");
  expect_refused(folder_.path(), "this is a folder, not a file");
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  expect_refused(file_, "this is not a regular file");
  expect_refused("/dev/zero", "this is not a regular file");
}

}  // namespace
}  // namespace billow
