// Scene files for tests: a folder of their own, a small mesh, and a scene that names it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/scene/scene.h"
#include "tests/support/mesh_files.h"

namespace billow::test {

/// A folder with cloth.obj, a 3 x 3 grid of one square metre, y = 0, with texture coordinates and the group `edge`.
class SceneFolder : public TemporaryFolder {
 public:
  SceneFolder();
  std::filesystem::path scene(const std::string& yaml) const { return write("scene.yaml", yaml); }
};

/// A scene of one cloth with most sections in it, over cloth.obj.
extern const std::string base_scene;

/// `text` with the one occurrence of `find` replaced; fails the test when there is not exactly one.
std::string edited(const std::string& text, const std::string& find, const std::string& replacement);

/// The InputError that reading gives, its file's folder left out; "" when it gives none.
std::string scene_error(const std::filesystem::path& file, const std::vector<cli::Override>& overrides = {});

}  // namespace billow::test
