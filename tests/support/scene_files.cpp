// Scene files for tests.
#include "tests/support/scene_files.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace billow::test {
namespace {

namespace fs = std::filesystem;

std::string grid_obj() {
  std::string obj;
  for (int z = 0; z < 3; ++z)
    for (int x = 0; x < 3; ++x) obj += "v " + std::to_string(x * 0.5) + " 0 " + std::to_string(z * 0.5) + "\n";
  for (int z = 0; z < 3; ++z)
    for (int x = 0; x < 3; ++x) obj += "vt " + std::to_string(x * 0.5) + " " + std::to_string(1 - z * 0.5) + "\n";
  for (const int corner : {1, 2, 4, 5}) {
    obj += corner == 1 ? "g edge\n" : corner == 4 ? "g rest\n" : "";
    obj += "f";
    for (const int v : {corner, corner + 3, corner + 4, corner + 1})
      obj += " " + std::to_string(v) + "/" + std::to_string(v);
    obj += "\n";
  }
  return obj;
}

}  // namespace

const std::string base_scene = R"(billow: 1
duration: 2
gravity: [0, -9.81, 0]
bodies:
  - name: sheet
    cloth:
      mesh: cloth.obj
      mass: 0.2
      stiffness: {structural: 115, shear: 80, bend: 35}
      damping: {model: projected, coefficient: 0}
      pins: [{corner: top_left}]
    colour: "#808080"
solver:
  method: fb_euler
  step: auto
  filter: {kernel: exponential, lambda: 1}
render:
  size: [64, 48]
  fps: 25
  samples: 4
  views: [textured]
  camera: {eye: [0, 0, 3], look_at: [0, 0, 0], fov: 40}
strip: {step: 0.01}
)";

SceneFolder::SceneFolder() { write("cloth.obj", grid_obj()); }

std::string edited(const std::string& text, const std::string& find, const std::string& replacement) {
  const std::size_t at = text.find(find);
  EXPECT_NE(at, std::string::npos) << find;
  EXPECT_EQ(text.find(find, at + 1), std::string::npos) << find << " is there twice";
  return at == std::string::npos ? text : std::string(text).replace(at, find.size(), replacement);
}

std::string scene_error(const fs::path& file, const std::vector<cli::Override>& overrides) {
  const std::string folder = file.parent_path().string() + "/";
  try {
    cli::read_scene(file, overrides);
  } catch (const InputError& error) {
    std::string message = error.what();
    for (std::size_t at; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
    return message;
  }
  return "";
}

}  // namespace billow::test
