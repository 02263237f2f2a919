// Temporary file, checked write, checked close, rename.
#include "base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"

namespace billow {
namespace {

std::atomic<bool> durable = false;

// Of this process on this machine alone; another machine, or a process that was killed, may have left the same.
std::filesystem::path temporary_name(const std::filesystem::path& target) {
  static std::atomic<unsigned> counter{0};
  return target.parent_path() / fmt::format(".{}.{}-{}.part", target.filename().string(), getpid(), counter++);
}

// Renaming over a device or a pipe would replace it with a file.
void require_file_or_nothing(const std::filesystem::path& target) {
  std::error_code ignored;
  const auto status = std::filesystem::status(target, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw OutputError(fmt::format("cannot write {}: it exists and is not a file", target.string()));
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target) : target_(target) {
  require_file_or_nothing(target);
  int descriptor = -1;
  do {
    temporary_ = temporary_name(target);
    descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) fail();
  stream_ = fdopen(descriptor, "wb");
  if (!stream_) {
    close(descriptor);
    unlink(temporary_.c_str());
    fail();
  }
}

AtomicFile::~AtomicFile() {
  if (stream_) std::fclose(stream_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

bool AtomicFile::write(const void* bytes, std::size_t size) noexcept {
  return std::fwrite(bytes, 1, size, stream_) == size;
}

void AtomicFile::append(std::string_view bytes) {
  if (!write(bytes.data(), bytes.size())) fail();
}

void AtomicFile::commit() {
  // A full disk may show only here: small files sit in the stream's buffer until it is closed.
  std::FILE* stream = std::exchange(stream_, nullptr);
  const bool flushed = std::fflush(stream) == 0 && (!durable || fsync(fileno(stream)) == 0);
  const int flush_error = errno;
  if (std::fclose(stream) != 0) fail();
  if (!flushed) {
    errno = flush_error;
    fail();
  }
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail();
  temporary_.clear();
}

void AtomicFile::fail() const {
  throw OutputError(fmt::format("cannot write {}: {}", target_.string(), std::strerror(errno)));
}

void write_durably() { durable = true; }

void settle_names(const std::filesystem::path& folder) {
  if (!durable) return;
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool settled = descriptor >= 0 && fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  if (!settled) throw OutputError(fmt::format("cannot write {}: {}", folder.string(), std::strerror(error)));
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_directory() && !entry.is_symlink()) settle_names(entry.path());
}

void write_file_atomically(const std::filesystem::path& file, const std::string& contents) {
  AtomicFile output(file);
  output.append(contents);
  output.commit();
}

}  // namespace billow
