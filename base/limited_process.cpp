// fork, limits, a pipe for the reply, and a parent that waits no longer than it said.
#include "base/limited_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/out_of_memory.h"

namespace billow {
namespace {

using Clock = std::chrono::steady_clock;

// The reply's first byte says whether it is what `work` returned or what it threw.
constexpr char reply_tag = 'R', error_tag = 'E';
constexpr int exit_out_of_memory = 3;  // more than the limit
constexpr int exit_nothing_left = 4;   // within the limit: nobody had that much

// ---- the child ----

void lower_limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
  rlimit limit{};
  getrlimit(resource, &limit);
  limit.rlim_max = std::min(limit.rlim_max, hard);
  limit.rlim_cur = std::min({soft, limit.rlim_cur, limit.rlim_max});
  setrlimit(resource, &limit);
}

// Address space in use: a limit has to leave the child what the parent already had. Without an allocation.
rlim_t address_space_bytes() {
  std::array<char, 64> text{};
  const int statm = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  const ssize_t size = read(statm, text.data(), text.size() - 1);
  close(statm);
  const unsigned long pages = size > 0 ? std::strtoul(text.data(), nullptr, 10) : 0;
  return static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

rlim_t space_limit = RLIM_INFINITY;  // of this child
constexpr rlim_t larger_pieces = 4 << 20;

// Whether it asked for more than it may have, or the machine had less. Small pieces are taken from larger ones, so that
// some space is left when there is none for the next.
[[noreturn]] void end_without_memory(const char*, std::size_t bytes) {
  _exit(address_space_bytes() + bytes + larger_pieces > space_limit ? exit_out_of_memory : exit_nothing_left);
}

void restrict_self(const ProcessLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGSEGV, SIGABRT, SIGXCPU})
    std::signal(signal, SIG_DFL);
  const auto cpu = static_cast<rlim_t>(std::max(limits.cpu_seconds, 1));
  lower_limit(RLIMIT_CPU, cpu, cpu + 1);
  lower_limit(RLIMIT_CORE, 0, 0);
  lower_limit(RLIMIT_FSIZE, 0, 0);
#ifndef BILLOW_SANITIZE  // the address sanitizer maps terabytes
  space_limit = address_space_bytes() + limits.memory_bytes;
  lower_limit(RLIMIT_AS, space_limit, space_limit);
#endif
}

void silence() {
  const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, standard);
  close(null);
}

void write_all(int out, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(out, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(1);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

// The child's whole life. It leaves through _exit: the parent's buffers and exit handlers are not its own.
[[noreturn]] void serve(const std::function<std::string()>& work, const ProcessLimits& limits, int out) {
  silence();
  restrict_self(limits);
  set_out_of_memory_action(end_without_memory);
  std::set_new_handler([] { _exit(exit_out_of_memory); });
  char tag = reply_tag;
  std::string reply;
  try {
    reply = work();
  } catch (const std::bad_alloc&) {
    _exit(exit_out_of_memory);
  } catch (const std::exception& error) {
    tag = error_tag;
    reply = error.what();
  }
  write_all(out, {&tag, 1});
  write_all(out, reply);
  _exit(0);
}

// ---- the parent ----

// A child that is killed, if it still runs, and reaped when it goes out of scope.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    kill();
    wait();
  }

  void kill() const {
    if (pid_ > 0) ::kill(pid_, SIGKILL);
  }

  int wait() {
    int status = 0;
    while (pid_ > 0 && waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status;
  }

 private:
  pid_t pid_;
};

struct Descriptor {
  explicit Descriptor(int number) : number(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(number); }
  int number;
};

[[noreturn]] void fail(const char* what) {
  throw ResourceError(fmt::format("cannot start the mesh importer: {}: {}", what, std::strerror(errno)));
}

bool readable_before(int in, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd descriptor{in, POLLIN, 0};
    const int ready = poll(&descriptor, 1, static_cast<int>(std::min<long long>(left, 60'000)));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

// Everything the child sends, tag included, until it closes its end.
std::string read_reply(int in, const ProcessLimits& limits) {
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.wall_seconds));
  std::string reply;
  std::array<char, 1 << 16> block;
  for (;;) {
    if (!readable_before(in, deadline))
      throw InputError(fmt::format("it took longer than {:g} s; the file is broken or too large", limits.wall_seconds));
    const ssize_t count = read(in, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return reply;
    reply.append(block.data(), static_cast<std::size_t>(count));
    if (reply.size() > limits.reply_bytes + 1)
      throw InputError("it unpacks to more than the limit; use a smaller mesh");
  }
}

std::string signal_reason(int signal, const ProcessLimits& limits) {
  if (signal == SIGXCPU || signal == SIGKILL)
    return fmt::format(
        "it took more than {} s of processor time or more memory than there is; the file is broken or "
        "too large",
        std::max(limits.cpu_seconds, 1));
  if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) return "the import was interrupted";
  return fmt::format("the importer crashed on it (SIG{}); the file is probably broken, export it again",
                     sigabbrev_np(signal) ? sigabbrev_np(signal) : std::to_string(signal));
}

std::string failure_reason(int status, const ProcessLimits& limits) {
  if (WIFSIGNALED(status)) return signal_reason(WTERMSIG(status), limits);
  if (WIFEXITED(status) && WEXITSTATUS(status) == exit_out_of_memory)
    return fmt::format("it needs more than {} MiB of memory; the file is broken or too large",
                       limits.memory_bytes >> 20);
  if (WIFEXITED(status) && WEXITSTATUS(status) == exit_nothing_left) throw ResourceError("out of memory");
  return "the importer stopped on it; the file is probably broken, export it again";
}

}  // namespace

std::string reply_of_child(const std::function<std::string()>& work, const ProcessLimits& limits) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail("pipe");
  const Descriptor in(ends[0]);
  const pid_t pid = fork();
  if (pid == 0) {
    close(ends[0]);  // where few files may be open, `work` needs each
    serve(work, limits, ends[1]);
  }
  close(ends[1]);
  if (pid < 0) fail("fork");

  Child child(pid);
  std::string reply = read_reply(in.number, limits);
  const int status = child.wait();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || reply.empty()) throw InputError(failure_reason(status, limits));
  const bool failed = reply.front() == error_tag;
  reply.erase(0, 1);
  if (failed) throw InputError(reply);
  return reply;
}

}  // namespace billow
