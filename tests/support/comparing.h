// What tests of comparing share: pictures, and the tool that compares them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render/image/png.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow::test {

/// Compares files of a folder of its own.
class Comparing : public testing::Test {
 protected:
  // Dark on the left, light on the right.
  static render::Image picture(int width = 20, int height = 10, int channels = 3) {
    render::Image image(width, height, channels);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < channels; ++c) image.row(y)[x * channels + c] = x < width / 2 ? 40 : 200;
    return image;
  }

  static render::Image changed(render::Image image, int x, int y, int by) {
    for (int c = 0; c < 3; ++c)
      image.row(y)[x * image.channels + c] = static_cast<std::uint8_t>(image.row(y)[x * image.channels + c] + by);
    return image;
  }

  void write(const std::string& name, const render::Image& image) const {
    std::filesystem::create_directories((folder_.path() / name).parent_path());
    render::write_png(folder_.path() / name, image);
  }

  ToolResult compare(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "compare");
    return run_tool(arguments, folder_.path());
  }

  // The one row of two images that differ.
  std::string why(const render::Image& a, const render::Image& b) const {
    write("a.png", a);
    write("b.png", b);
    return nlohmann::json::parse(compare({"a.png", "b.png", "--json"}).output)["images"][0]["why"];
  }

  TemporaryFolder folder_;
};

}  // namespace billow::test
