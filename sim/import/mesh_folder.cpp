// Paths that lead out of a folder, and files that are read whole.
#include "sim/import/mesh_folder.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file_trust.h"

namespace billow::sim {

namespace fs = std::filesystem;

MeshFolder::MeshFolder(const fs::path& mesh_file, std::uintmax_t max_file_bytes)
    : folder_(fs::canonical(fs::absolute(mesh_file).parent_path())),
      mesh_(fs::weakly_canonical(fs::absolute(mesh_file))),
      max_file_bytes_(max_file_bytes) {}

MeshFolder::Answer MeshFolder::ask(const fs::path& file) const {
  std::error_code error;
  const fs::path written = file.is_absolute() ? file : folder_ / file;
  const fs::path path = fs::weakly_canonical(written, error);
  if (error || (path != mesh_ && !is_below(path, folder_)))
    return is_below(written.lexically_normal(), folder_) ? Answer::link_outside : Answer::outside;
  if (!fs::is_regular_file(path, error)) return Answer::missing;
  return fs::file_size(path, error) <= max_file_bytes_ ? Answer::allowed : Answer::too_large;
}

std::string MeshFolder::read(const std::string& file) const {
  switch (ask(file)) {
    case Answer::outside:
    case Answer::link_outside:
      throw InputError(outside_reason(file, ask(file)));
    case Answer::missing:
      throw InputError(fmt::format("it refers to '{}', which is not there; keep all files of a mesh together", file));
    case Answer::too_large:
      throw InputError(fmt::format("it refers to '{}', which has more than {} bytes", file, max_file_bytes_));
    case Answer::allowed:
      break;
  }
  return read_bytes(folder_ / file);
}

std::string outside_reason(const std::string& file, MeshFolder::Answer answer) {
  return fmt::format("it refers to '{}', which is {} its own folder; keep all files of a mesh together", file,
                     answer == MeshFolder::Answer::link_outside ? "a link that leads out of" : "outside");
}

std::string read_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(fmt::format("it cannot be opened: {}", std::strerror(errno)));
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw InputError("it cannot be read");
  return bytes;
}

}  // namespace billow::sim
