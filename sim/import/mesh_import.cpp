// What the tool asks of a mesh file before and after assimp sees it.
#include "sim/import/mesh_import.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <new>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/file_trust.h"
#include "base/limited_process.h"
#include "sim/import/assimp_reader.h"
#include "sim/import/gltf_document.h"
#include "sim/import/gltf_reader.h"
#include "sim/import/mesh_folder.h"
#include "sim/import/obj_reader.h"
#include "sim/import/off_reader.h"
#include "sim/import/ply_reader.h"
#include "sim/import/soup_codec.h"
#include "sim/import/stl_reader.h"

namespace billow::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 6> supported = {".obj", ".off", ".stl", ".ply", ".gltf", ".glb"};

// Assimp reads 5 MB and more in a second, so a file that takes longer than this is broken, and a small broken file
// is found out within a second or so.
constexpr std::uintmax_t bytes_per_cpu_second = 1'000'000;

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

void check_file(const fs::path& file, const ImportLimits& limits) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::none) throw InputError(fmt::format("it cannot be read: {}", error.message()));
  if (!fs::exists(status)) throw InputError("there is no such file; check the path");
  if (fs::is_directory(status)) throw InputError("it is a folder; name a file in it");
  if (!fs::is_regular_file(status)) throw InputError("it is not a plain file; name a mesh file");
  const std::string extension = lower_extension(file);
  if (extension.empty())
    throw InputError(fmt::format("its name has no extension; it must be one of {}", fmt::join(supported, " ")));
  if (std::find(supported.begin(), supported.end(), extension) == supported.end())
    throw InputError(fmt::format("its extension '{}' is none of {}; convert it to one of these", extension,
                                 fmt::join(supported, " ")));
  const std::uintmax_t bytes = fs::file_size(file);
  if (bytes == 0) throw InputError("it is empty; export it again");
  if (bytes > limits.max_file_bytes)
    throw InputError(
        fmt::format("it has {} bytes, and the limit is {}; use a coarser mesh", bytes, limits.max_file_bytes));
}

// Assimp reads what it reads right; the other formats have readers of their own (docs/meshes.md says why).
PolygonSoup read_soup(const fs::path& file, const ImportLimits& limits) {
  const std::string extension = lower_extension(file);
  if (extension == ".obj") return read_obj(file, limits);
  if (extension == ".off") return read_off(file, limits);
  if (extension == ".ply") return read_ply(file, limits);
  if (extension == ".stl") {
    std::string bytes = read_bytes(file);
    if (is_text_stl(bytes)) return read_text_stl(std::move(bytes), limits);
    check_binary_stl(bytes, limits);
    return read_with_assimp(file, limits);
  }
  try {
    return read_gltf(file, limits);
  } catch (const OldGltf&) {
    return read_with_assimp(file, limits);
  }
}

// The same, where the file has to be a mesh before anything of it is shown.
PolygonSoup read_unquoted_soup(const fs::path& file, const ImportLimits& limits) try {
  return read_soup(file, limits);
} catch (const std::bad_alloc&) {
  throw;
} catch (const std::exception&) {
  throw InputError(fmt::format(
      "it is damaged or no such mesh; 'billow mesh {}' says why: here nothing is shown of files outside of the named "
      "one's folder",
      file.lexically_normal().string()));
}

ProcessLimits process_limits(const fs::path& file, const ImportLimits& limits) {
  constexpr std::size_t bytes_per_vertex = 24 + 8 + 12 + 32 + 40;  // position, uv, colour, some groups; the layout
  constexpr std::size_t bytes_per_face = 3 * sizeof(Face);         // two of them of the layout; textures
  const std::uintmax_t cpu_seconds = 1 + fs::file_size(file) / bytes_per_cpu_second;
  return {.memory_bytes = limits.memory_bytes,
          .cpu_seconds = static_cast<int>(std::min<std::uintmax_t>(cpu_seconds, limits.cpu_seconds)),
          .wall_seconds = limits.wall_seconds,
          .reply_bytes = bytes_per_vertex * limits.max_vertices + bytes_per_face * limits.max_faces +
                         static_cast<std::size_t>(limits.max_file_bytes)};
}

}  // namespace

Mesh import_mesh(const fs::path& file, const ImportLimits& limits) try {
  check_file(file, limits);
  const auto& read = may_be_quoted(file) ? read_soup : read_unquoted_soup;
  return weld(
      decode_soup(reply_of_child([&] { return encode_soup(read(file, limits)); }, process_limits(file, limits))));
} catch (const InputError& error) {
  throw InputError(fmt::format("cannot read mesh {}: {}", file.string(), error.what()));
}

}  // namespace billow::sim
