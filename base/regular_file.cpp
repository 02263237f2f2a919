// Looked at before it is opened, because opening alone may wait or act; and after, because it may have been replaced.
#include "base/regular_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace billow {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_file(const fs::path& file, const std::string& reason) {
  throw InputError(fmt::format("{}: {}", file.string(), reason));
}

[[noreturn]] void refuse_for_error(const fs::path& file, const char* what) {
  if (errno == ENOENT || errno == ENOTDIR) refuse_file(file, "no such file");
  refuse_file(file, fmt::format("{}: {}", what, std::strerror(errno)));
}

void check(const fs::path& file, const struct stat& status) {
  if (S_ISDIR(status.st_mode)) refuse_file(file, "this is a folder, not a file");
  if (!S_ISREG(status.st_mode)) refuse_file(file, "this is not a regular file");
}

class OpenFile {
 public:
  explicit OpenFile(const fs::path& file) : file_(file) {
    struct stat status = {};
    if (stat(file.c_str(), &status) != 0) refuse_for_error(file, "cannot be opened");
    check(file, status);
    descriptor_ = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor_ < 0) refuse_for_error(file, "cannot be opened");
    fstat(descriptor_, &status);
    size_ = static_cast<std::uintmax_t>(status.st_size);
    try {
      check(file, status);
    } catch (...) {
      close(descriptor_);
      throw;
    }
  }
  ~OpenFile() { close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  std::uintmax_t size() const { return size_; }

  // From `offset` to the end, or until there are more than `most`.
  std::string read_from(std::uintmax_t offset, std::uintmax_t most) const {
    std::string bytes;
    std::array<char, 1 << 16> block;
    while (bytes.size() <= most) {
      const ssize_t got = pread(descriptor_, block.data(), block.size(), static_cast<off_t>(offset + bytes.size()));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) refuse_for_error(file_, "cannot be read");
      if (got == 0) break;
      bytes.append(block.data(), static_cast<std::size_t>(got));
    }
    return bytes;
  }

 private:
  const fs::path& file_;
  int descriptor_ = -1;
  std::uintmax_t size_ = 0;
};

}  // namespace

std::string read_regular_file(const fs::path& file, std::uintmax_t max_bytes, std::string_view hint_when_larger) {
  const OpenFile open(file);
  // A file that grows meanwhile is caught too.
  std::string bytes = open.size() > max_bytes ? "" : open.read_from(0, max_bytes);
  if (open.size() > max_bytes || bytes.size() > max_bytes)
    refuse_file(file, fmt::format("larger than {} KiB{}", max_bytes / 1024, hint_when_larger));
  return bytes;
}

std::string read_tail(const fs::path& file, std::size_t most) {
  const OpenFile open(file);
  std::string bytes = open.read_from(open.size() - std::min<std::uintmax_t>(open.size(), most), most);
  bytes.resize(std::min(bytes.size(), most));
  return bytes;
}

}  // namespace billow
