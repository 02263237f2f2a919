// scene: of a study or a test.
#include "cli/scene/scene_path.h"

#include <fmt/format.h>

#include <system_error>

#include "base/file_trust.h"
#include "cli/scene/scene_parts.h"

namespace billow::cli {

namespace {

// Faults of a scene are shown with what stands there, so an outside file has to be one first.
void check_outside_scene(const std::filesystem::path& scene) {
  bool is_scene = false;
  try {
    is_scene = read_yaml_file(scene)->find("billow") != nullptr;
  } catch (const InputError&) {
    // said below, without the file's words
  }
  const std::string shown = scene.lexically_normal().string();
  if (!is_scene) throw InputError(fmt::format("{} is no scene file; 'billow check {}' says why", shown, shown));
}

}  // namespace

std::filesystem::path read_scene_path(MapReader& map, const std::filesystem::path& folder) {
  const std::filesystem::path scene = folder / map.text("scene");
  located(map.where("scene"), [&] { require_trusted(scene); });
  std::error_code error;
  if (!std::filesystem::exists(scene, error))
    fail_at(map.where("scene"),
            fmt::format("there is no scene file {}; the path is relative to this file's folder", scene.string()));
  if (!may_be_quoted(scene)) located(map.where("scene"), [&] { check_outside_scene(scene); });
  return scene;
}

}  // namespace billow::cli
