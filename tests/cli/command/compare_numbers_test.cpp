// billow compare from outside: images of 16 bits and of floats.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/image/exr.h"
#include "tests/support/comparing.h"

namespace billow {
namespace {

using render::Image;
using test::ToolResult;
using testing::HasSubstr;
using Json = nlohmann::json;

class CompareBits : public test::Comparing {};

// Grey of 16 bits, a ramp.
render::Image16 ramp(int change_at = -1, int by = 1) {
  render::Image16 image{20, 10, {}};
  for (int k = 0; k < 200; ++k) image.pixels.push_back(static_cast<std::uint16_t>(257 * k + (k == change_at ? by : 0)));
  return image;
}

TEST_F(CompareBits, FindsADifferenceOfOneIn65535) {
  render::write_png(folder_.path() / "a.png", ramp());
  render::write_png(folder_.path() / "b.png", ramp(47));
  EXPECT_EQ(compare({"a.png", "b.png"}).status, 0);
  const ToolResult strict = compare({"a.png", "b.png", "--channel", "0", "--pixels", "0"});
  EXPECT_EQ(strict.status, 3);
  EXPECT_THAT(strict.output, HasSubstr("1 px over 0/255 (0.5 %), worst 0.003891 (1/65535) at (7, 2)"));
  EXPECT_EQ(compare({"a.png", "b.png", "--channel", "0.002%", "--pixels", "0"}).status, 0);
  EXPECT_EQ(compare({"a.png", "b.png", "--channel", "0.001%", "--pixels", "0"}).status, 3);
  const Json json = Json::parse(compare({"a.png", "b.png", "--json"}).output)["images"][0];
  EXPECT_EQ(json["bits"], 16);
  EXPECT_EQ(json["worst_values"], (Json{47 * 257, 47 * 257 + 1}));
}

TEST_F(CompareBits, SaysThatOneOfTwoHasFewerBits) {
  render::write_png(folder_.path() / "a.png", ramp(47, 100));
  Image eight(20, 10);
  for (int k = 0; k < 600; ++k) eight.pixels[k] = static_cast<std::uint8_t>(k / 3);
  write("b.png", eight);
  const ToolResult result = compare({"a.png", "b.png"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output,
              HasSubstr("same: no pixel over 3/255, worst 0.3891 (100/65535) at (7, 2), 16 against 8 bits"));
}

class CompareExr : public test::Comparing {
 protected:
  static render::DataImage numbers(std::initializer_list<const char*> names, int change_at = -1, float by = 0.5f) {
    render::DataImage image{20, 10, {}};
    for (const char* name : names) {
      image.channels.push_back({name, std::vector<float>(200)});
      for (int k = 0; k < 200; ++k) image.channels.back().value[k] = 0.001f * k + (k == change_at ? by : 0.0f);
    }
    return image;
  }
  void write(const std::string& name, const render::DataImage& image) const {
    std::filesystem::create_directories((folder_.path() / name).parent_path());
    render::write_exr(folder_.path() / name, image);
  }
};

TEST_F(CompareExr, SaysWhatDiffersInItsOwnUnits) {
  write("a/v.exr", numbers({"Z", "velocity.X"}));
  write("b/v.exr", numbers({"Z", "velocity.X"}));
  EXPECT_EQ(compare({"a", "b"}).status, 0);
  render::DataImage other = numbers({"Z", "velocity.X"});
  other.channels[1].value[47] += 0.5f;
  write("b/v.exr", other);
  const ToolResult result = compare({"a", "b"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(
      result.output,
      HasSubstr("1 px over 0.0118 (0.5 %), worst 0.5 in velocity.X at (7, 2): 0.047 and 0.547, none at an edge"));
  const Json json = Json::parse(compare({"a", "b", "--json"}).output)["images"][0];
  EXPECT_EQ(json["bits"], "float");
  EXPECT_EQ(json["channels"]["Z"]["over"], 0);
  EXPECT_EQ(json["channels"]["velocity.X"]["over"], 1);
  EXPECT_TRUE(json["ssim"].is_null());
  EXPECT_EQ(compare({"a", "b", "--metric", "max=0.51"}).status, 0);
  EXPECT_EQ(compare({"a", "b", "--metric", "max=0.49"}).status, 3);
  EXPECT_EQ(compare({"a", "b", "--channel", "51%", "--worst", "51%", "--pixels", "0"}).status, 0);
  EXPECT_THAT(compare({"a", "b", "--metric", "flip=1"}).output,
              HasSubstr("flip is of colours, and the images have no channels R, G and B; judge them by max or rmse"));
}

TEST_F(CompareExr, JudgesColoursAsTheyAreSeen) {
  write("a.exr", numbers({"R", "G", "B"}));
  write("b.exr", numbers({"R", "G", "B", "A"}));
  EXPECT_EQ(compare({"a.exr", "b.exr"}).status, 3);
  EXPECT_EQ(compare({"a.exr", "b.exr", "--ignore-alpha"}).status, 0);
  EXPECT_EQ(compare({"a.exr", "b.exr", "--metric", "ssim=0.9999", "--metric", "flip=0.0001"}).status, 0);
  EXPECT_EQ(compare({"a.exr", "b.exr", "--diff", "d.png"}).status, 3);
  EXPECT_EQ(render::read_png(folder_.path() / "d.png").row(0)[0], 255);  // alpha is 0, and 1
}

TEST_F(CompareExr, TellsWhatCannotBeCompared) {
  write("a/1.exr", numbers({"R", "G", "B"}));
  write("b/1.exr", numbers({"R", "G", "B", "N.X", "N.Y"}));
  write("a/2.exr", numbers({"Z"}));
  folder_.write("b/2.exr", test::read_text(folder_.path() / "a/2.exr").substr(0, 400));
  folder_.write("a/3.exr", "no image");
  folder_.write("b/3.exr", "no image");
  const ToolResult result = compare({"a", "b"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.output, HasSubstr("DIFFERENT: channels N.X, N.Y only in b/1.exr"));
  EXPECT_THAT(result.output, HasSubstr("UNREADABLE: b/2.exr: "));
  EXPECT_THAT(result.output, HasSubstr("UNREADABLE: a/3.exr: is no OpenEXR image"));
}

}  // namespace
}  // namespace billow
