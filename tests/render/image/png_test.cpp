#include "render/image/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "base/error.h"
#include "tests/support/mesh_files.h"
#include "tests/support/png_bytes.h"

namespace billow::render {
namespace {

using test::png_bytes;
using testing::HasSubstr;

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Image pattern(int width, int height, int channels) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i * 31 + i / 7);
  return image;
}

long peak_mebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss >> 10;
}

int files_in(const std::filesystem::path& folder) {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

class Png : public testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder.path() / name; }
  Image read(const std::string& bytes) const { return read_png(folder.write("image.png", bytes)); }
  std::string fault(const std::string& bytes) const {
    try {
      read(bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  test::TemporaryFolder folder;
};

std::vector<int> values(const Image& image) { return {image.pixels.begin(), image.pixels.end()}; }

TEST_F(Png, ComesBackAsItWasWritten) {
  for (const int channels : {3, 4})
    for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {3, 70}, {301, 200}}) {
      const Image image = pattern(width, height, channels);
      write_png(path("a.png"), image);
      const Image back = read_png(path("a.png"));
      EXPECT_EQ(back.width, width);
      EXPECT_EQ(back.height, height);
      EXPECT_EQ(back.channels, channels);
      EXPECT_EQ(back.pixels, image.pixels);
    }
}

TEST_F(Png, GivesTheSameBytesForTheSamePixels) {
  write_png(path("a.png"), pattern(50, 40, 3));
  write_png(path("b.png"), pattern(50, 40, 3));
  EXPECT_EQ(contents(path("a.png")), contents(path("b.png")));
  EXPECT_THAT(contents(path("a.png")), HasSubstr("sRGB"));
  EXPECT_THAT(contents(path("a.png")), testing::Not(HasSubstr("tIME")));
}

TEST_F(Png, WrittenRowByRowEqualsWrittenAtOnce) {
  const Image image = pattern(20, 30, 3);
  write_png(path("whole.png"), image);
  write_png_rows(path("rows.png"), 20, 30, 3, [&](int y, std::uint8_t* row) { std::copy_n(image.row(y), 60, row); });
  EXPECT_EQ(contents(path("whole.png")), contents(path("rows.png")));
}

TEST_F(Png, ReadsEveryKindAsEightBitColour) {
  EXPECT_EQ(values(read(png_bytes({.width = 2, .colour_type = 0}, "\x10\x80"))),
            (std::vector<int>{16, 16, 16, 128, 128, 128}));
  EXPECT_EQ(values(read(png_bytes({.width = 2, .depth = 1, .colour_type = 0}, "\x40"))),
            (std::vector<int>{0, 0, 0, 255, 255, 255}));
  EXPECT_EQ(values(read(png_bytes({.width = 1, .colour_type = 4}, "\x10\x20"))), (std::vector<int>{16, 16, 16, 32}));
  EXPECT_EQ(values(read(png_bytes({.width = 1, .colour_type = 6}, "\x01\x02\x03\x04"))),
            (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(values(read(png_bytes({.width = 1, .depth = 16, .colour_type = 2}, "\x10\x10\x20\x20\x30\x30"))),
            (std::vector<int>{16, 32, 48}));
}

TEST_F(Png, ReadsPalettesAndTheirTransparency) {
  const std::string palette = "\x0a\x14\x1e\x28\x32\x3c";
  EXPECT_EQ(values(read(png_bytes({.width = 2, .depth = 4, .colour_type = 3, .palette = palette}, "\x10"))),
            (std::vector<int>{40, 50, 60, 10, 20, 30}));
  EXPECT_EQ(values(read(png_bytes({.width = 1, .colour_type = 3, .palette = palette, .transparent = "\x07"},
                                  std::string(1, '\0')))),
            (std::vector<int>{10, 20, 30, 7}));
}

// Of one column and two rows, Adam7 has a row in its first image and the other in its last.
TEST_F(Png, ReadsInterlacedFiles) {
  EXPECT_EQ(values(read(png_bytes({.width = 1, .height = 2, .interlace = 1}, "abcdef"))),
            values(read(png_bytes({.width = 1, .height = 2}, "abcdef"))));
}

TEST_F(Png, GivesTheSameRowsOneByOne) {
  const Image image = pattern(20, 30, 4);
  write_png(path("a.png"), image);
  PngRows rows(path("a.png"));
  ASSERT_EQ(rows.width(), 20);
  ASSERT_EQ(rows.height(), 30);
  ASSERT_EQ(rows.channels(), 4);
  for (int y = 0; y < 30; ++y) EXPECT_TRUE(std::equal(image.row(y), image.row(y) + 80, rows.next())) << y;
}

TEST_F(Png, SaysWhatIsWrongWithAFile) {
  const std::string good = png_bytes({.width = 2}, "abcdef");
  EXPECT_THAT(fault(""), HasSubstr("image.png: the image is empty"));
  EXPECT_THAT(fault("GIF89a and so on, for at least a header's length"), HasSubstr("is not a PNG image"));
  EXPECT_THAT(fault(good.substr(0, 20)), HasSubstr("cut short"));
  EXPECT_THAT(fault(good.substr(0, 50)), HasSubstr("damaged"));
  EXPECT_THAT(fault(good.substr(0, good.size() - 12)), HasSubstr("damaged"));  // no IEND
  EXPECT_THROW(read_png(folder.path()), InputError);
  try {
    read_png(path("absent.png"));
    ADD_FAILURE() << "a missing file was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("absent.png: cannot open the image: No such file"));
  }
}

TEST_F(Png, RefusesEveryFlippedByte) {
  const std::string good = png_bytes({.width = 4, .height = 4}, std::string(48, 'x'));
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x55);
    EXPECT_NE(fault(bad), "") << "byte " << i;
  }
}

// A text of a gigabyte is claimed by one chunk and unpacked from the other.
TEST_F(Png, SkipsWhatIsNotPixels) {
  const std::string good = png_bytes({.width = 2}, "abcdef"), head = good.substr(0, 33), rest = good.substr(33);
  EXPECT_EQ(read(head + test::png_chunk("tEXt", std::string("a\0b", 3)) + rest).width, 2);
  EXPECT_EQ(read(head + test::png_chunk("zTXt", std::string("a\0\0no deflate", 13)) + rest).width, 2);
  std::string claims = test::png_chunk("tEXt", std::string("a\0b", 3));
  claims[0] = 0x3f;
  const long before = peak_mebibytes();
  EXPECT_THAT(fault(head + claims), HasSubstr("damaged"));
  EXPECT_LT(peak_mebibytes(), before + 64);
}

TEST_F(Png, RefusesAClaimThatItsBytesCannotHold) {
  std::string bytes = png_bytes({.width = 8192}, std::string(3 * 8192, ' '));
  bytes[22] = '\x20';  // of the height's four bytes from 20 on
  bytes[23] = '\0';
  EXPECT_THAT(fault(bytes), HasSubstr("8192 x 8192 pixels do not fit in it"));
}

TEST_F(Png, RefusesToWaitForAPipe) {
  ASSERT_EQ(mkfifo(path("pipe.png").c_str(), 0600), 0);
  try {
    read_png(path("pipe.png"));
    ADD_FAILURE() << "a pipe was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("is not a regular file"));
  }
}

TEST_F(Png, RefusesImagesTooLargeToHold) {
  EXPECT_THAT(fault(png_bytes({.width = 8193}, std::string(3 * 8193, ' '))),
              HasSubstr("8193 x 1 pixels; at most 8192 x 8192"));
  EXPECT_THAT(fault(png_bytes({.width = 2000000000}, "")), HasSubstr("at most 8192"));
  EXPECT_EQ(read(png_bytes({.width = 8192}, std::string(3 * 8192, ' '))).width, 8192);
}

TEST_F(Png, ReplacesAFileWholeAndLeavesNothingBeside) {
  write_png(path("a.png"), pattern(9, 9, 3));
  write_png(path("a.png"), pattern(5, 5, 3));
  EXPECT_EQ(read_png(path("a.png")).width, 5);
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST_F(Png, SaysWhyItCannotWrite) {
  try {
    write_png(path("no/such/folder/a.png"), pattern(1, 1, 3));
    ADD_FAILURE() << "wrote into a folder that is not there";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.png: No such file or directory"));
  }
}

TEST_F(Png, NeverReplacesADeviceOrAFolder) {
  EXPECT_THROW(write_png("/dev/full", pattern(1, 1, 3)), OutputError);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  std::filesystem::create_directory(path("folder.png"));
  EXPECT_THROW(write_png(path("folder.png"), pattern(1, 1, 3)), OutputError);
  EXPECT_EQ(files_in(folder.path()), 1);
}

// A full disk, as seen by a child process that may write `limit` bytes to a file: true when `write` throws OutputError.
template <typename Write>
bool fails_on_a_disk_of(rlim_t limit, const Write& write) {
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit size{limit, limit};
    setrlimit(RLIMIT_FSIZE, &size);
    try {
      write();
    } catch (const OutputError& error) {
      _exit(std::string(error.what()).find("File too large") != std::string::npos ? 1 : 2);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

// Small files fail at the close, large ones at a write.
TEST_F(Png, KeepsWhatWasThereWhenTheDiskIsFull) {
  write_png(path("a.png"), pattern(9, 9, 3));
  const std::string before = contents(path("a.png"));
  for (const int size : {12, 400}) {
    EXPECT_TRUE(fails_on_a_disk_of(50, [&] { write_png(path("a.png"), pattern(size, size, 3)); })) << size;
    EXPECT_TRUE(fails_on_a_disk_of(50, [&] { write_png(path("new.png"), pattern(size, size, 3)); })) << size;
    EXPECT_EQ(contents(path("a.png")), before);
    EXPECT_EQ(files_in(folder.path()), 1) << "something was left behind";
  }
}

TEST_F(Png, AnyBytesAreWrittenWholeOrNotAtAll) {
  write_file_atomically(path("run.json"), "{}");
  EXPECT_EQ(contents(path("run.json")), "{}");
  EXPECT_TRUE(fails_on_a_disk_of(1, [&] { write_file_atomically(path("run.json"), "{\"longer\": 1}"); }));
  EXPECT_EQ(contents(path("run.json")), "{}");
  EXPECT_EQ(files_in(folder.path()), 1);
}

}  // namespace
}  // namespace billow::render
