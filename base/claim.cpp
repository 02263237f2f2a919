// A claim is written under a name of its own and then linked to the name that all want, so that it is never seen half
// written and only one can have it.
#include "base/claim.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <functional>
#include <sstream>
#include <thread>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/folder_lock.h"
#include "base/process_space.h"
#include "base/regular_file.h"

namespace billow {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_bytes = 4096;
constexpr int most_looks = 1000;

[[noreturn]] void fail(const fs::path& file) {
  throw OutputError(fmt::format("cannot claim {}: {}", file.string(), std::strerror(errno)));
}

// ---- who a process is ----

/// What the kernel says of a process besides its number, which is given to another one day.
struct ProcessState {
  char state = '?';     // 'Z': it has ended
  std::string started;  // clock ticks after the boot
};

// From /proc/PID/stat, whose second field, in brackets, may hold anything.
ProcessState process_state(long process) {
  ProcessState state;
  try {
    const std::string stat = read_regular_file(fmt::format("/proc/{}/stat", process), max_bytes);
    std::istringstream fields(stat.substr(std::min(stat.rfind(')') + 1, stat.size())));
    fields >> state.state;
    std::string field;
    for (int number = 4; number <= 22 && fields >> field; ++number)
      if (number == 22) state.started = field;
  } catch (const InputError&) {
    // /proc may be hidden: kill() alone says then whether it lives
  }
  return state;
}

// ---- what a claim says ----

/// A claim as it lies there.
struct Standing {
  std::string text;
  ClaimHolder holder;
  std::string space, started;
  std::time_t touched = 0;
};

std::string value_of(const std::string& text, std::string_view key) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(fmt::format("{}: ", key))) return line.substr(key.size() + 2);
  return "";
}

std::string unique_mark() {
  std::uint64_t bits = 0;
  if (getrandom(&bits, sizeof bits, 0) != sizeof bits) throw OutputError("the system has no random numbers");
  return fmt::format("{:016x}", bits);
}

std::string claim_text(const std::string& mark) {
  return fmt::format("host: {}\nprocess: {}\nsince: {:%Y-%m-%d %H:%M:%S} UTC\nspace: {}\nstarted: {}\nmark: {}\n",
                     host_name(), getpid(), fmt::gmtime(std::time(nullptr)), process_space(),
                     process_state(getpid()).started, mark);
}

// Nothing when it is gone.
std::optional<Standing> look_at(const fs::path& file) {
  struct stat status = {};
  if (lstat(file.c_str(), &status) != 0) {
    if (errno == ENOENT) return std::nullopt;
    fail(file);
  }
  Standing standing;
  try {
    standing.text = read_regular_file(file, max_bytes);
  } catch (const InputError& error) {
    if (lstat(file.c_str(), &status) != 0 && errno == ENOENT) return std::nullopt;
    throw InputError(fmt::format("{}; it stands where a claim belongs: remove it", error.what()));
  }
  // Opening it has brought the time up to date where a network file system had an old one.
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  standing.touched = status.st_mtim.tv_sec;
  standing.space = value_of(standing.text, "space"), standing.started = value_of(standing.text, "started");
  standing.holder.host = plain_ascii(value_of(standing.text, "host"));
  std::istringstream(value_of(standing.text, "process")) >> standing.holder.process;
  standing.holder.since = plain_ascii(value_of(standing.text, "since"));
  standing.holder.is_near = standing.holder.process > 0 && standing.space == process_space();
  return standing;
}

bool lives(const Standing& standing, std::time_t now) {
  if (!standing.holder.is_near) {
    const std::time_t silence = now > standing.touched ? now - standing.touched : standing.touched - now;
    return silence <= Claim::dead_after.count();
  }
  if (kill(static_cast<pid_t>(standing.holder.process), 0) != 0 && errno == ESRCH) return false;
  const ProcessState state = process_state(standing.holder.process);
  const bool is_another = !state.started.empty() && state.started != standing.started;
  return state.state != 'Z' && state.state != 'X' && !is_another;
}

// ---- taking and letting go ----

/// A claim under a name of its own, removed with it.
class Draft {
 public:
  explicit Draft(const fs::path& file) : mark_(unique_mark()), text_(claim_text(mark_)), wanted_(file) {
    own_ = temporary_name(file);
    unfinished_.emplace(own_, new_file, 0666);
    if (unfinished_->descriptor() < 0) fail(file);
    fill(unfinished_->descriptor(), own_);
    struct stat status = {};
    if (stat(own_.c_str(), &status) != 0) fail(file);
    time_ = status.st_mtim.tv_sec;
  }
  ~Draft() { unlink(own_.c_str()); }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  const std::string& text() const { return text_; }
  // Now, as the file system tells time.
  std::time_t time() const { return time_; }

  // Gives it the name that is wanted, if nobody has that.
  bool publish() const {
    if (link(own_.c_str(), wanted_.c_str()) == 0) return true;
    if (errno == EEXIST) return false;
    if (errno != EPERM && errno != EOPNOTSUPP && errno != ENOSYS && errno != EMLINK) fail(wanted_);
    return write_to(wanted_);  // there are no links here
  }

 private:
  // False when the file exists.
  bool write_to(const fs::path& file) const {
    const int descriptor = open(file.c_str(), new_file, 0666);
    if (descriptor < 0 && errno == EEXIST) return false;
    if (descriptor < 0) fail(wanted_);
    fill(descriptor, file);
    return true;
  }

  // Closes it too.
  void fill(int descriptor, const fs::path& file) const {
    const bool whole = write(descriptor, text_.data(), text_.size()) == static_cast<ssize_t>(text_.size());
    const int error = errno;
    if (close(descriptor) == 0 && whole) return;
    errno = error;
    unlink(file.c_str());
    fail(wanted_);
  }

  static constexpr int new_file = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;

  std::string mark_, text_;
  fs::path wanted_, own_;
  std::optional<UnfinishedFile> unfinished_;
  std::time_t time_ = 0;
};

// Removes the claim if it is one that may go. Two that find the same dead claim must not remove each other's new one:
// the lock keeps them apart, and where there are no locks, what was moved away by mistake is put back.
void remove_if(const fs::path& file, const std::function<bool(const Standing&)>& may_go) {
  const FolderLock lock(file.has_parent_path() ? file.parent_path() : fs::path("."));
  const std::optional<Standing> present = look_at(file);
  if (!present || !may_go(*present)) return;
  const fs::path aside = temporary_name(file);
  if (std::rename(file.c_str(), aside.c_str()) != 0) {
    if (errno == ENOENT) return;
    fail(file);
  }
  const std::optional<Standing> moved = look_at(aside);
  const bool mistaken = moved && moved->text != present->text;
  if (mistaken && link(aside.c_str(), file.c_str()) != 0 && errno != EEXIST) fail(file);
  unlink(aside.c_str());
}

}  // namespace

std::variant<Claim, ClaimHolder> take_claim(const fs::path& file) {
  const Draft draft(file);
  for (int look = 0; look < most_looks; ++look) {
    if (draft.publish()) return Claim(file, draft.text());
    const std::optional<Standing> standing = look_at(file);
    // A server's answer may have been lost on its way, and the second asking refused.
    if (standing && standing->text == draft.text()) return Claim(file, draft.text());
    if (standing && lives(*standing, draft.time())) return standing->holder;
    if (standing)
      remove_if(file, [&](const Standing& present) { return !lives(present, draft.time()); });
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // it was let go of this moment
  }
  throw OutputError(fmt::format("cannot claim {}: it comes and goes", file.string()));
}

// Whether a holder elsewhere is dead only the file system's clock could tell.
void remove_dead_claim(const fs::path& file) {
  const auto is_dead = [](const Standing& standing) { return standing.holder.is_near && !lives(standing, 0); };
  const std::optional<Standing> standing = look_at(file);
  if (standing && is_dead(*standing)) remove_if(file, is_dead);
}

std::optional<ClaimHolder> claim_holder(const fs::path& file) {
  const std::optional<Standing> standing = look_at(file);
  if (!standing || !lives(*standing, std::time(nullptr))) return std::nullopt;
  return standing->holder;
}

Claim::Claim(Claim&& other) noexcept
    : file_(std::exchange(other.file_, fs::path())), text_(std::exchange(other.text_, std::string())) {}

Claim& Claim::operator=(Claim&& other) noexcept {
  if (this == &other) return *this;
  let_go();
  file_ = std::exchange(other.file_, fs::path());
  text_ = std::exchange(other.text_, std::string());
  return *this;
}

Claim::~Claim() { let_go(); }

void Claim::let_go() noexcept {
  if (file_.empty()) return;
  try {
    remove_if(file_, [&](const Standing& present) { return present.text == text_; });
  } catch (const std::exception&) {
    // What cannot be removed goes with this process, or for others with time.
  }
  file_.clear();
}

// A file system that gives no answer just now is no reason to stop.
bool Claim::renew() const {
  try {
    const std::optional<Standing> present = look_at(file_);
    if (!present || present->text != text_) return false;
  } catch (const std::runtime_error&) {
    return true;
  }
  utimensat(AT_FDCWD, file_.c_str(), nullptr, 0);
  return true;
}

}  // namespace billow
