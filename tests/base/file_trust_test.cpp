// Whose files may be read, and whose may be quoted.
#include "base/file_trust.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/support/mesh_files.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// job/scene.yaml, beside another folder; the links lead from one to the other.
class FileTrust : public testing::Test {
 protected:
  FileTrust() {
    for (const char* name : {"job", "job/deep", "other"}) fs::create_directory(path(name));
    for (const char* name : {"job/scene.yaml", "job/grid.obj", "job/deep/grid.obj", "other/grid.obj"})
      folder_.write(name, "x");
    fs::create_symlink("deep/grid.obj", path("job/own.obj"));
    fs::create_symlink("../other/grid.obj", path("job/away.obj"));
    fs::create_symlink("../other", path("job/way"));
    fs::create_symlink("../job/grid.obj", path("other/back.obj"));
    fs::create_symlink("round", path("job/round"));
  }
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  std::string refusal(const std::string& name) const {
    try {
      require_trusted(path(name));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
};

TEST_F(FileTrust, ReadsWhatIsInTheFolderWhereverItIsWritten) {
  trust_folder_of(path("job/scene.yaml"), Outside::refused);
  for (const char* name : {"job/grid.obj", "job/deep/grid.obj", "job/deep/../grid.obj", "job/own.obj", "job/none.obj",
                           "other/../job/grid.obj"})
    EXPECT_EQ(refusal(name), "") << name;
}

TEST_F(FileTrust, RefusesWhatLeadsOutOfIt) {
  trust_folder_of(path("job/scene.yaml"), Outside::refused);
  for (const char* name : {"other/grid.obj", "other/none.obj", "job/deep/../../other/grid.obj", "jobs/grid.obj",
                           "other/back.obj", "../../../../etc/passwd"})
    EXPECT_THAT(refusal(name), HasSubstr("is outside, and with --untrusted nothing outside of")) << name;
  for (const char* name : {"job/away.obj", "job/way/grid.obj", "job/way/none.obj"})
    EXPECT_THAT(refusal(name), HasSubstr("is a link that leads out of its folder, and with --untrusted")) << name;
  EXPECT_THAT(refusal("job/round"), HasSubstr("cannot be followed (Too many levels of symbolic links)"));
  EXPECT_THAT(refusal("job/" + std::string(5000, 'a')), HasSubstr("cannot be followed (File name too long)"));
}

TEST_F(FileTrust, TellsLinksFromPathsHoweverTheFolderIsWritten) {
  for (const char* named : {"job/./scene.yaml", "job/deep/../scene.yaml", "other/../job//scene.yaml"}) {
    trust_folder_of(path(named), Outside::refused);
    EXPECT_EQ(refusal("job/grid.obj"), "") << named;
    EXPECT_THAT(refusal("job/away.obj"), HasSubstr("is a link")) << named;
    EXPECT_THAT(refusal("other/grid.obj"), HasSubstr("is outside")) << named;
  }
}

// It would read another file's folder as its own.
TEST_F(FileTrust, RefusesANamedFileThatIsALinkOutOfItsFolder) {
  EXPECT_THROW(trust_folder_of(path("job/away.obj"), Outside::refused), InputError);
  EXPECT_NO_THROW(trust_folder_of(path("job/own.obj"), Outside::refused));
  EXPECT_NO_THROW(trust_folder_of(path("job/away.obj"), Outside::readable));
}

TEST_F(FileTrust, QuotesOnlyTheNamedFileAndItsFolder) {
  trust_folder_of(path("job/scene.yaml"), Outside::readable);
  EXPECT_EQ(refusal("other/grid.obj"), "");
  EXPECT_TRUE(may_be_quoted(path("job/scene.yaml")));
  EXPECT_TRUE(may_be_quoted(path("job/own.obj")));
  for (const char* name : {"other/grid.obj", "job/away.obj", "job/way/grid.obj", "job/round"})
    EXPECT_FALSE(may_be_quoted(path(name))) << name;
  trust_folder_of(path("job/away.obj"), Outside::readable);
  EXPECT_TRUE(may_be_quoted(path("job/away.obj")));
}

}  // namespace
}  // namespace billow
