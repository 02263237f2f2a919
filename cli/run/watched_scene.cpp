// Every file is a piece of one phase.
#include "cli/run/watched_scene.h"

namespace billow::cli {

Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides, Progress& progress) {
  const auto watch = [&](const std::filesystem::path& read) {
    progress.phase("reading", read.lexically_normal().string());
  };
  watch(file);
  return read_scene(file, overrides, watch);
}

}  // namespace billow::cli
