// Meshes and textures of a scene.
#include "cli/scene/scene_files.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/file_trust.h"
#include "cli/scene/scene_parts.h"
#include "sim/import/mesh_import.h"

namespace billow::cli {

namespace fs = std::filesystem;

void TextureBudget::take(std::size_t pixels) {
  if (pixels > left_)
    throw InputError("with it, the scene's textures have more than 2^28 pixels in all; use smaller ones");
  left_ -= pixels;
}

void check_file(const fs::path& file, std::string_view kind, const std::string& where) {
  if (file.empty()) return;
  located(where, [&] { require_trusted(file); });
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  const std::string shown = file.lexically_normal().string();
  if (status.type() == fs::file_type::not_found) fail_at(where, fmt::format("there is no {} file {}", kind, shown));
  if (status.type() == fs::file_type::none)
    fail_at(where, fmt::format("the {} {} cannot be read: {}", kind, shown, error.message()));
  if (!fs::is_regular_file(status))
    fail_at(where,
            fmt::format("the {} {} is not a regular file; name one, or save what comes from it as one", kind, shown));
}

sim::Mesh load_mesh(const fs::path& file, const std::string& where, const FileWatch& watch) {
  if (watch) watch(file);
  return located(where, [&] { return sim::import_mesh(file); });
}

}  // namespace billow::cli
