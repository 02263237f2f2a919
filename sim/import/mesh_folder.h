// What a mesh file may open: itself, its own folder's files and nothing else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace billow::sim {

/// The folder tree that a mesh file stands in. A mesh may name any path as its material, buffer or texture. Where the
/// mesh is a link, the folder is that of the link.
class MeshFolder {
 public:
  /// `max_file_bytes`: the largest file that is opened.
  MeshFolder(const std::filesystem::path& mesh_file, std::uintmax_t max_file_bytes);

  enum class Answer { allowed, outside, link_outside, missing, too_large };
  /// Whether `file` (absolute, or within the folder) is the mesh itself or a regular file of the tree, links followed.
  Answer ask(const std::filesystem::path& file) const;

  /// The bytes of `file`. Throws InputError that names it and why it cannot be read.
  std::string read(const std::string& file) const;

  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_, mesh_;  // links followed
  std::uintmax_t max_file_bytes_;
};

/// Why `file` may not be read where the answer is outside or link_outside.
std::string outside_reason(const std::string& file, MeshFolder::Answer answer);

/// The bytes of a file. Throws InputError where it cannot be opened or read.
std::string read_bytes(const std::filesystem::path& file);

}  // namespace billow::sim
