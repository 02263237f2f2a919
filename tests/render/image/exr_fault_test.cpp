// What is found wrong with OpenEXR files.
#include "render/image/exr.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/mesh_files.h"

namespace billow::render {
namespace {

DataImage image_with_note() {
  DataImage image;
  image.width = 4;
  image.height = 3;
  image.channels.push_back({"Z", std::vector<float>(12, 0.5f)});
  image.notes.emplace_back("note", "text");
  return image;
}

TEST(ExrFault, IsNoneOfWhatWasWritten) {
  const test::TemporaryFolder folder;
  write_exr(folder.path() / "a.exr", image_with_note());
  EXPECT_EQ(exr_fault(folder.path() / "a.exr", 4, 3), std::nullopt);
}

// OpenEXR would make room for two gibibytes first.
TEST(ExrFault, IsATextThatIsLongerThanTheFile) {
  const test::TemporaryFolder folder;
  write_exr(folder.path() / "a.exr", image_with_note());
  std::ifstream in(folder.path() / "a.exr", std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string type("\0string\0", 8);
  ASSERT_NE(bytes.find(type), std::string::npos);
  bytes.replace(bytes.find(type) + type.size(), 4, "\xff\xff\xff\x7f");
  EXPECT_EQ(exr_fault(folder.write("long.exr", bytes), 4, 3), "is damaged: its header does not add up");
}

// OpenEXR reads on to the list's own end, and takes what follows for sizes.
TEST(ExrFault, IsAListOfChannelsThatIsLongerThanItsSize) {
  const test::TemporaryFolder folder;
  write_exr(folder.path() / "a.exr", image_with_note());
  std::ifstream in(folder.path() / "a.exr", std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string type("\0chlist\0", 8);
  const std::size_t size = bytes.find(type) + type.size();
  ASSERT_EQ(bytes[size], 2 + 16 + 1);  // "Z" and its end, what is said of it, the end of the list
  bytes[size] = 18;
  EXPECT_EQ(exr_fault(folder.write("list.exr", bytes), 4, 3), "is damaged: its header does not add up");
}

}  // namespace
}  // namespace billow::render
