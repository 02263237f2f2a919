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

// Empty where there is no current folder any more.
fs::path absolute_of(const fs::path& path) {
  std::error_code error;
  fs::path result = fs::absolute(path, error);
  return error ? fs::path() : result;
}

// What does not exist keeps its name; empty, with `error`, where links go round in circles or may not be followed.
fs::path resolved(const fs::path& path, std::error_code& error) {
  error.clear();
  fs::path result = fs::weakly_canonical(path, error);
  return error ? fs::path() : result;
}

fs::path resolved(const fs::path& path) {
  std::error_code ignored;
  return resolved(path, ignored);
}

// A link stands where it stands and leads where it leads: both have to be inside.
bool is_inside(const fs::path& file) {
  return is_below(resolved(file), named_file->folder) && is_below(resolved(file.parent_path()), named_file->folder);
}

// What keeps `file`, which is not inside, from being read. Of what is written outside nothing more is told.
std::string way_out(const fs::path& file) {
  if (!is_below(file.lexically_normal(), named_file->written_folder)) return "is outside";
  std::error_code error;
  resolved(file, error);
  return error ? fmt::format("cannot be followed ({})", error.message()) : "is a link that leads out of its folder";
}

}  // namespace

bool is_below(const fs::path& path, const fs::path& folder) {
  return !folder.empty() && std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

void trust_folder_of(const fs::path& named, Outside outside) {
  const fs::path absolute = absolute_of(named);
  named_file = {absolute.lexically_normal().parent_path(), resolved(absolute.parent_path()), resolved(absolute),
                outside};
  require_trusted(named);
}

void require_trusted(const fs::path& file) {
  if (!named_file || named_file->outside == Outside::readable) return;
  const fs::path absolute = absolute_of(file);
  if (is_inside(absolute)) return;
  throw InputError(fmt::format("{} {}, and with --untrusted nothing outside of {} is read; copy it there",
                               file.lexically_normal().string(), way_out(absolute),
                               named_file->written_folder.string()));
}

bool may_be_quoted(const fs::path& file) {
  if (!named_file) return true;
  const fs::path absolute = absolute_of(file);
  return resolved(absolute) == named_file->file || is_inside(absolute);
}

}  // namespace billow
