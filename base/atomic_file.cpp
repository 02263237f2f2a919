// Temporary file, checked write, checked close, rename.
#include "base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <regex>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/process_space.h"

namespace billow {
namespace {

std::atomic<bool> durable = false;

constexpr std::string_view ending = ".part";

// A short form of where process numbers mean something, as a temporary file's name has it.
std::string numbering() {
  std::uint32_t hash = 2166136261u;  // FNV-1a
  for (const char c : process_space()) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return fmt::format("{:08x}", hash);
}

const std::string& own_numbering() {
  static const std::string numbers = numbering();
  return numbers;
}

// What a temporary file's name says of who writes it.
struct Writer {
  std::string numbering;
  long process = 0;
};

std::optional<Writer> writer_of(const std::string& name) {
  static const std::regex pattern(R"(\..+\.([0-9a-f]{8})-([0-9]{1,9})-[0-9]{1,10}\.part)", std::regex::optimize);
  std::smatch match;
  if (!name.ends_with(ending) || !std::regex_match(name, match, pattern)) return std::nullopt;
  return Writer{match[1], std::stol(match[2])};
}

bool is_gone(const Writer& writer, const std::filesystem::path& file) {
  const std::string& own = own_numbering();
  if (writer.numbering == own && writer.process == getpid()) return !is_unfinished(file.filename().native());
  if (writer.numbering == own) return kill(static_cast<pid_t>(writer.process), 0) != 0 && errno == ESRCH;
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  return !error && std::filesystem::file_time_type::clock::now() - written > std::chrono::hours(24);
}

// Renaming over a device or a pipe would replace it with a file.
void require_file_or_nothing(const std::filesystem::path& target) {
  std::error_code ignored;
  const auto status = std::filesystem::status(target, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw OutputError(fmt::format("cannot write {}: it exists and is not a file", target.string()));
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& target) {
  static std::atomic<unsigned> counter{0};
  constexpr std::size_t longest = 200;  // [byte] of the file's own name: with the rest no more than file systems take
  return target.parent_path() / fmt::format(".{}.{}-{}-{}{}", target.filename().string().substr(0, longest),
                                            own_numbering(), getpid(), counter++, ending);
}

AtomicFile::AtomicFile(const std::filesystem::path& target) : target_(target) {
  require_file_or_nothing(target);
  open_temporary();
  const int descriptor = unfinished_->descriptor();
  stream_ = fdopen(descriptor, "wb");
  if (!stream_) {
    close(descriptor);
    unlink(temporary_.c_str());
    fail();
  }
}

// A name that is taken is that of a stray, of an earlier process with this number.
void AtomicFile::open_temporary() {
  do {
    temporary_ = temporary_name(target_);
    unfinished_.emplace(temporary_, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (unfinished_->descriptor() < 0 && errno == EEXIST);
  if (unfinished_->descriptor() < 0) fail();
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

void remove_strays(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> strays;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const auto writer = writer_of(entry->path().filename().native());
    if (writer && is_gone(*writer, entry->path())) strays.push_back(entry->path());
  }
  for (const std::filesystem::path& stray : strays) std::filesystem::remove(stray, error);
}

bool is_temporary_name(std::string_view name) { return writer_of(std::string(name)).has_value(); }

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
