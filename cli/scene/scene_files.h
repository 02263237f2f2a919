// Opening the files that a scene names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "cli/scene/scene.h"

namespace billow::cli {

/// The pixels that all textures of a scene may have together: 2^28, a GiB of memory and some 20 s of decoding.
class TextureBudget {
 public:
  /// Throws InputError where they are more than there are left.
  void take(std::size_t pixels);

 private:
  std::size_t left_ = std::size_t{1} << 28;
};

/// Throws InputError at `where` unless there is a regular file that is trusted (base/file_trust.h); `kind` is what
/// messages call it. An empty path is none.
void check_file(const std::filesystem::path& file, std::string_view kind, const std::string& where);

/// Reads the textures of what is drawn with `mesh` and leaves the mesh with the materials that are used, numbered as
/// the finishes are; `watch`, where there is one, hears of each file before. `mesh_file` may be empty. A texture that
/// the mesh names and that cannot be read, or that is over the budget, joins what is ignored of it. Throws InputError
/// at one that the scene names.
void load_look(Look& look, sim::Mesh& mesh, const std::filesystem::path& mesh_file, const FileWatch& watch,
               TextureBudget& budget);

/// Imports the mesh, which `watch` hears of before. Throws InputError at `where`.
sim::Mesh load_mesh(const std::filesystem::path& file, const std::string& where, const FileWatch& watch);

}  // namespace billow::cli
