// Paths are compared as the system resolves them.
#include "base/file_trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/error.h"

namespace billow {
namespace {

namespace fs = std::filesystem;

/// The named file and its folder: as they were written, and links followed.
struct Named {
  fs::path written_folder, folder, file;
  Outside outside = Outside::readable;
};

std::optional<Named> named_file;

// What does not exist keeps its name; empty where links go round in circles or may not be followed.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  fs::path result = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? fs::path() : result;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return !folder.empty() && std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// A link stands where it stands and leads where it leads: both have to be inside.
bool is_inside(const fs::path& file) {
  return is_below(resolved(file), named_file->folder) && is_below(resolved(file.parent_path()), named_file->folder);
}

}  // namespace

void trust_folder_of(const fs::path& named, Outside outside) {
  const fs::path absolute = fs::absolute(named);
  named_file = {absolute.parent_path().lexically_normal(), resolved(absolute.parent_path()), resolved(absolute),
                outside};
  require_trusted(named);
}

void require_trusted(const fs::path& file) {
  if (!named_file || named_file->outside == Outside::readable) return;
  const fs::path absolute = fs::absolute(file);
  if (is_inside(absolute)) return;
  const bool written_inside = is_below(absolute.lexically_normal(), named_file->written_folder);
  throw InputError(fmt::format("{} {} the folder {}, and with --untrusted nothing else is read; put a copy there",
                               file.lexically_normal().string(),
                               written_inside ? "is a link that leads out of" : "is outside of",
                               named_file->written_folder.string()));
}

bool may_be_quoted(const fs::path& file) {
  if (!named_file) return true;
  const fs::path absolute = fs::absolute(file);
  return resolved(absolute) == named_file->file || is_inside(absolute);
}

}  // namespace billow
