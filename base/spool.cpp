// Unnamed temporary files.
#include "base/spool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "base/error.h"

namespace billow {
namespace {

int open_unnamed(const std::filesystem::path& folder) {
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR)) return descriptor;
  std::string name = (folder / ".spool.XXXXXX").string();  // for file systems without O_TMPFILE
  const int named = mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) unlink(name.c_str());
  return named;
}

}  // namespace

Spool::Spool(const std::filesystem::path& purpose)
    : purpose_(purpose),
      descriptor_(open_unnamed(purpose.has_parent_path() ? purpose.parent_path() : std::filesystem::path("."))) {
  if (descriptor_ < 0) fail();
}

Spool::~Spool() {
  if (descriptor_ >= 0) close(descriptor_);
}

Spool::Spool(Spool&& other) noexcept
    : purpose_(std::move(other.purpose_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

Spool& Spool::operator=(Spool&& other) noexcept {
  std::swap(purpose_, other.purpose_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void Spool::append(const void* bytes, std::size_t size) {
  const auto* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = write(descriptor_, from, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    from += written;
    size -= static_cast<std::size_t>(written);
  }
}

void Spool::read(void* bytes, std::size_t size, std::size_t offset) const {
  auto* to = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t got = pread(descriptor_, to, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got == 0) errno = EIO;
    if (got <= 0) fail();
    to += got;
    offset += static_cast<std::size_t>(got);
    size -= static_cast<std::size_t>(got);
  }
}

void Spool::copy_to(AtomicFile& file, std::size_t size) const {
  std::string piece(std::min(size, std::size_t{1} << 16), '\0');
  for (std::size_t done = 0; done < size; done += piece.size()) {
    piece.resize(std::min(piece.size(), size - done));
    read(piece.data(), piece.size(), done);
    file.append(piece);
  }
}

void Spool::fail() const {
  throw OutputError(fmt::format("cannot write {}: {}", purpose_.string(), std::strerror(errno)));
}

}  // namespace billow
