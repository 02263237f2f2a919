// Paths in fixed memory, so that a handler finds them whatever state the process is in.
#include "base/sudden_end.h"

#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>

namespace billow {

namespace {

struct Slot {
  std::atomic<bool> taken = false, holds = false;
  pid_t owner = 0;
  char path[PATH_MAX] = {};
};
std::array<Slot, 512> slots;

constexpr std::size_t most_words = 32;

struct Mark {
  std::atomic<bool> stands = false;
  pid_t owner = 0;
  off_t offset = 0;
  char path[PATH_MAX] = {}, present[most_words] = {}, failed[most_words] = {}, interrupted[most_words] = {};
};
Mark standing;

// Files that are being opened and have no slot yet, and whether there may be more.
std::atomic<int> openings = 0;
std::atomic<bool> tidying = false;

void wait_a_moment() {
  const timespec moment{0, 1'000'000};
  nanosleep(&moment, nullptr);
}

void begin_opening() {
  for (;;) {
    ++openings;
    if (!tidying) return;
    --openings;
    wait_a_moment();
  }
}

// Not for ever: memory may have run out in the thread that is opening a file.
void end_openings() {
  tidying = true;
  for (int moments = 0; openings > 0 && moments < 100; ++moments) wait_a_moment();
}

bool fits(const std::filesystem::path& file) { return file.native().size() < PATH_MAX; }

// What `work` says of the marked file, open; false where something else stands there.
template <class Work>
bool with_marked_file(const Work& work) noexcept {
  if (!standing.stands || standing.owner != getpid()) return false;
  const int file = open(standing.path, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (file < 0) return false;
  const std::size_t size = std::strlen(standing.present);
  char found[most_words] = {};
  const bool stands = pread(file, found, size, standing.offset) == static_cast<ssize_t>(size) &&
                      std::memcmp(found, standing.present, size) == 0;
  const bool done = stands && work(file);
  return close(file) == 0 && done;
}

// Keeps signals that tidy up away from this thread while a file is open and has no slot yet.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t those;
    sigemptyset(&those);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&those, signal);
    pthread_sigmask(SIG_BLOCK, &those, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_;
};

int take_slot(const std::filesystem::path& file) {
  if (!fits(file)) return -1;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (slots[k].taken.exchange(true)) continue;
    std::strcpy(slots[k].path, file.c_str());
    slots[k].owner = getpid();
    slots[k].holds = true;
    return static_cast<int>(k);
  }
  return -1;
}

}  // namespace

UnfinishedFile::UnfinishedFile(const std::filesystem::path& file, int flags, unsigned mode) {
  int error = 0;
  {
    const SignalsWait wait;
    begin_opening();
    descriptor_ = open(file.c_str(), flags, mode);
    error = errno;
    if (descriptor_ >= 0) slot_ = take_slot(file);
    --openings;
  }
  errno = error;
}

UnfinishedFile::~UnfinishedFile() {
  if (slot_ < 0) return;
  Slot& slot = slots[static_cast<std::size_t>(slot_)];
  slot.holds = false;
  slot.taken = false;
}

bool is_unfinished(std::string_view name) {
  const auto is_it = [&](const Slot& slot) {
    return slot.holds && slot.owner == getpid() && std::filesystem::path(slot.path).filename() == name;
  };
  return std::any_of(slots.begin(), slots.end(), is_it);
}

StandingMark::StandingMark(const std::filesystem::path& file, off_t offset, const std::string& present,
                           const std::string& failed, const std::string& interrupted) {
  if (!fits(file) || present.size() >= most_words) return;
  if (failed.size() != present.size() || interrupted.size() != present.size()) return;
  std::strcpy(standing.path, file.c_str());
  std::strcpy(standing.present, present.c_str());
  std::strcpy(standing.failed, failed.c_str());
  std::strcpy(standing.interrupted, interrupted.c_str());
  standing.offset = offset;
  standing.owner = getpid();
  standing.stands = true;
}

StandingMark::~StandingMark() { standing.stands = false; }

bool mark(SuddenEnd why) noexcept {
  const char* words = why == SuddenEnd::failure ? standing.failed : standing.interrupted;
  const std::size_t size = std::strlen(words);
  return with_marked_file(
      [&](int file) { return pwrite(file, words, size, standing.offset) == static_cast<ssize_t>(size); });
}

bool mark_stands() noexcept {
  return with_marked_file([](int) { return true; });
}

void tidy_up(SuddenEnd why) noexcept {
  end_openings();
  for (const Slot& slot : slots)
    if (slot.holds && slot.owner == getpid()) unlink(slot.path);
  mark(why);
}

}  // namespace billow
