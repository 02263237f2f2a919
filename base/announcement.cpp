// setitimer, and a handler that only writes.
#include "base/announcement.h"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <list>

namespace billow {
namespace {

std::atomic<const std::string*> waiting = nullptr;
static_assert(std::atomic<const std::string*>::is_always_lock_free);  // else a handler could wait for itself

void write_waiting(int) {
  const int error = errno;
  if (const std::string* line = waiting.exchange(nullptr)) {
    const ssize_t written = write(STDERR_FILENO, line->data(), line->size());
    static_cast<void>(written);  // a closed stderr is no reason to stop
  }
  errno = error;
}

void set_timer(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  setitimer(ITIMER_REAL, &timer, nullptr);
}

void handle_timer() {
  struct sigaction action = {};
  action.sa_handler = write_waiting;
  action.sa_flags = SA_RESTART;
  sigaction(SIGALRM, &action, nullptr);
}

}  // namespace

void announce_later(std::string line, double seconds) {
  // Lines stay for good: the handler may still be writing one in another thread when it is withdrawn.
  static std::list<std::string> lines;
  withdraw_announcement();
  handle_timer();
  waiting = &lines.emplace_back(std::move(line));
  set_timer(seconds);
}

void withdraw_announcement() {
  set_timer(0.0);
  waiting = nullptr;
}

}  // namespace billow
