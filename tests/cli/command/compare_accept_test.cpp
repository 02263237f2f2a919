// billow compare --accept from outside: what becomes a baseline, and what never does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/comparing.h"

namespace billow {
namespace {

using render::Image;
using test::ToolResult;
using testing::HasSubstr;
using Json = nlohmann::json;

class CompareAccept : public test::Comparing {};

TEST_F(CompareAccept, AcceptsWhatDiffersOrIsNewAndNothingElse) {
  unsetenv("CI");
  const Image other = changed(picture(), 3, 5, 60);
  write("a/differs.png", picture());
  write("b/differs.png", other);
  write("a/near.png", picture());
  write("b/near.png", changed(picture(), 3, 5, 1));
  write("b/below/new.png", other);
  write("a/gone.png", picture());
  write("a/broken.png", picture());
  folder_.write("b/broken.png", "no image");
  const std::string near = test::read_text(folder_.path() / "a/near.png");
  EXPECT_EQ(compare({"a", "b", "--accept-only", "differ.png"}).errors,
            "--accept-only: there is no image 'differ.png'; did you mean 'differs.png'?\n");
  EXPECT_EQ(compare({"a", "b", "--accept-only", "gone.png"}).status, 4);
  EXPECT_EQ(compare({"a", "b", "--accept-only", ""}).status, 4);  // a variable that is not set
  EXPECT_EQ(compare({"a", "b", "--accept-only", "broken.png"}).errors,
            "--accept-only: b/broken.png: is not a PNG image\n");
  EXPECT_THAT(compare({"a", "b", "--accept-only", "below/new.png"}).output, HasSubstr("accepted below/new.png\n"));
  EXPECT_EQ(render::read_png(folder_.path() / "a/below/new.png").pixels, other.pixels);
  EXPECT_EQ(render::read_png(folder_.path() / "a/differs.png").pixels, picture().pixels);

  const ToolResult all = compare({"a", "b", "--accept"});
  EXPECT_EQ(all.status, 3);  // one is gone, one broken
  EXPECT_THAT(all.output, HasSubstr("accepted differs.png\n"));
  EXPECT_EQ(render::read_png(folder_.path() / "a/differs.png").pixels, other.pixels);
  EXPECT_EQ(test::read_text(folder_.path() / "a/near.png"), near);
  EXPECT_EQ(render::read_png(folder_.path() / "a/broken.png").pixels, picture().pixels);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "a/gone.png"));
}

// What is to be mended then is the tolerance.
TEST_F(CompareAccept, AcceptsNothingThatCouldNotBeJudged) {
  unsetenv("CI");
  write("a/1.png", picture());
  write("b/1.png", changed(picture(), 3, 5, 100));
  folder_.write("a/1.tolerance.yaml", "reason: a lamp\nmask: none.png\n");
  const std::string before = test::read_text(folder_.path() / "a/1.png");
  const ToolResult all = compare({"a", "b", "--accept"});
  EXPECT_NE(all.status, 0);
  EXPECT_THAT(all.output, testing::Not(HasSubstr("accepted")));
  const ToolResult one = compare({"a", "b", "--accept-only", "1.png"});
  EXPECT_EQ(one.status, 4);
  EXPECT_THAT(one.errors, HasSubstr("--accept-only: 1.png: "));
  EXPECT_EQ(test::read_text(folder_.path() / "a/1.png"), before);
}

TEST_F(CompareAccept, AcceptsNothingWhereNobodyLooks) {
  write("a.png", picture());
  write("b.png", changed(picture(), 3, 5, 60));
  setenv("CI", "true", 1);
  const ToolResult result = compare({"a.png", "b.png", "--accept"});
  unsetenv("CI");
  EXPECT_EQ(result.status, 4);
  EXPECT_THAT(result.errors, HasSubstr("--accept: CI is set in the environment"));
  EXPECT_EQ(render::read_png(folder_.path() / "a.png").pixels, picture().pixels);
  EXPECT_EQ(compare({"a.png", "b.png", "--accept"}).status, 0);
  EXPECT_EQ(compare({"a.png", "b.png"}).status, 0);
}

TEST_F(CompareAccept, AcceptsOnlyWholeImagesAndThroughNoLink) {
  unsetenv("CI");
  folder_.write("a/damaged.png", "no image");
  write("b/damaged.png", picture());
  folder_.write("b/new.png", "no image");
  std::filesystem::create_directories(folder_.path() / "a");
  std::filesystem::create_directories(folder_.path() / "elsewhere");
  std::filesystem::create_directory_symlink("../elsewhere", folder_.path() / "a/sub");
  write("b/sub/x.png", picture());
  const ToolResult result = compare({"a", "b", "--accept"});
  EXPECT_EQ(result.status, 6);
  EXPECT_THAT(result.errors, HasSubstr("is a link, and nothing is written through it"));
  EXPECT_THAT(result.errors, HasSubstr("; accepted until then: damaged.png\n"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "elsewhere"));
  EXPECT_EQ(render::read_png(folder_.path() / "a/damaged.png").pixels, picture().pixels);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "a/new.png"));

  const ToolResult first = compare({"nothing yet", "b/sub", "--accept"});
  EXPECT_EQ(first.status, 0) << first.errors;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "nothing yet/x.png"));
}

}  // namespace
}  // namespace billow
