// Starting children, waiting for them, and ending them together.
#include "cli/study/study_jobs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <system_error>
#include <thread>

#include "base/claim.h"
#include "base/error.h"
#include "base/regular_file.h"
#include "cli/run/interrupt.h"

extern char** environ;

namespace billow::cli {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds look_again{20}, ask_again{500};

// A log begins anew: one of an earlier run, or what else has its name, is not written into.
int open_log(const std::filesystem::path& file) {
  unlink(file.c_str());
  const int log = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (log >= 0) return log;
  const char* reason = errno == EEXIST ? "it exists and is not a file; remove it" : std::strerror(errno);
  throw OutputError(fmt::format("cannot write {}: {}", file.string(), reason));
}

// The child from fork to exec, where only what is safe in a signal handler may be called.
[[noreturn]] void become(char* const* arguments, int log, pid_t parent) {
  // A group of its own: Ctrl-C at the terminal reaches the parent alone, which hands it on once.
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);  // it died before it could be told
  dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execve("/proc/self/exe", arguments, environ);
  static constexpr char words[] = "this program cannot be started again\n";
  const ssize_t written = write(STDERR_FILENO, words, sizeof words - 1);
  static_cast<void>(written);  // the status tells as well
  _exit(EXIT_FAILURE);
}

pid_t start_process(const JobCommand& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command.words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int log = open_log(command.log);
  const pid_t parent = getpid(), child = fork();
  const int error = errno;
  if (child == 0) become(arguments.data(), log, parent);
  close(log);
  if (child < 0) throw std::system_error(error, std::generic_category(), "cannot start another process");
  setpgid(child, child);  // here too: whoever comes first
  return child;
}

// Its number stays its own until it is waited for, so that what it has left in its group can be ended before.
bool has_ended(pid_t child) {
  siginfo_t end{};
  return waitid(P_PID, static_cast<id_t>(child), &end, WEXITED | WNOHANG | WNOWAIT) == 0 && end.si_pid == child;
}

// The status with which it ended, once it and what it has started are gone.
int end_group(pid_t child) {
  int status = 0;
  kill(-child, SIGKILL);
  waitpid(child, &status, 0);
  return status;
}

int exit_status(int wait_status) {
  return WIFSIGNALED(wait_status) ? 128 + WTERMSIG(wait_status) : WEXITSTATUS(wait_status);
}

/// The children that are running. Those that still are when it goes out of scope are ended.
class Children {
 public:
  explicit Children(std::chrono::seconds grace) : grace_(grace) {}
  ~Children() { end_all(SIGTERM); }
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  std::size_t count() const { return running_.size(); }

  void start(int number, const JobCommand& command) { running_[start_process(command)] = {number, Clock::now()}; }

  std::vector<int> numbers() const {
    std::vector<int> numbers;
    for (const auto& [process, child] : running_) numbers.push_back(child.number);
    return numbers;
  }

  /// The ends of those that have ended, waiting a moment for one.
  std::vector<JobEnd> wait_a_moment() {
    std::vector<JobEnd> ends;
    for (auto child = running_.begin(); child != running_.end();) {
      if (has_ended(child->first)) {
        const double seconds = std::chrono::duration<double>(Clock::now() - child->second.start).count();
        ends.push_back({child->second.number, exit_status(end_group(child->first)), seconds});
        child = running_.erase(child);
      } else {
        ++child;
      }
    }
    if (ends.empty()) std::this_thread::sleep_for(look_again);
    return ends;
  }

  /// Ends the one that does a run, at once.
  void kill_run(int number) {
    for (auto child = running_.begin(); child != running_.end(); ++child)
      if (child->second.number == number) {
        end_group(child->first);
        running_.erase(child);
        return;
      }
  }

  void end_all(int signal) {
    for (const auto& [process, child] : running_) kill(process, signal);
    const Clock::time_point end = Clock::now() + grace_;
    while (count() > 0 && Clock::now() < end) wait_a_moment();
    for (const int number : numbers()) kill_run(number);
  }

 private:
  struct Child {
    int number = 0;
    Clock::time_point start;
  };
  std::chrono::seconds grace_;      // for a child to end by itself
  std::map<pid_t, Child> running_;  // by process
};

/// The runs that are not done yet, and the children at some of them.
class JobList {
 public:
  JobList(const std::vector<int>& numbers, int jobs, std::chrono::seconds grace, JobKeeper& keeper)
      : jobs_(static_cast<std::size_t>(jobs)),
        keeper_(keeper),
        next_(numbers.begin(), numbers.end()),
        children_(grace) {}

  void run() {
    while (!next_.empty() || !held_.empty() || children_.count() > 0) {
      if (interrupted_by() != 0) return children_.end_all(interrupted_by());
      start_what_can();
      look_after();
      for (const JobEnd& end : children_.wait_a_moment()) keeper_.ended(end);
    }
  }

 private:
  bool has_room() const { return children_.count() < jobs_; }

  void start_what_can() {
    if (has_room() && Clock::now() >= next_asking_) {
      next_asking_ = Clock::now() + ask_again;
      next_.insert(next_.begin(), held_.begin(), held_.end());
      held_.clear();
    }
    while (!next_.empty() && has_room()) {
      const int number = next_.front();
      next_.pop_front();
      const Turn turn = keeper_.turn_of(number);
      if (turn == Turn::now) children_.start(number, keeper_.command_of(number));
      if (turn == Turn::later) held_.push_back(number);
    }
    if (children_.count() == 0 && !held_.empty()) keeper_.waits(held_);
  }

  void look_after() {
    if (Clock::now() < next_look_) return;
    next_look_ = Clock::now() + Claim::sign_interval;
    for (const int number : children_.numbers())
      if (!keeper_.goes_on(number)) {
        children_.kill_run(number);
        held_.push_back(number);
      }
  }

  const std::size_t jobs_;
  JobKeeper& keeper_;
  std::deque<int> next_;   // to be started
  std::vector<int> held_;  // by other processes
  Clock::time_point next_asking_{}, next_look_{};
  Children children_;
};

}  // namespace

std::string described_end(int status) {
  if (status <= 128) return fmt::format("exit status {}", status);
  const char* name = sigabbrev_np(status - 128);
  return fmt::format("ended by SIG{}", name ? name : std::to_string(status - 128));
}

std::string last_words(const std::filesystem::path& log) {
  constexpr std::size_t enough = 4 << 10;
  std::string text;
  try {
    text = read_tail(log, enough);
  } catch (const InputError& error) {
    return error.what();
  }
  text.erase(std::min(text.find_last_not_of('\n') + 1, text.size()));
  const std::size_t begin = text.rfind('\n') + 1;  // npos + 1 is 0
  return text.empty() ? "it left no message" : text.substr(begin);
}

void run_jobs(const std::vector<int>& numbers, int jobs, std::chrono::seconds grace, JobKeeper& keeper) {
  JobList(numbers, jobs, grace, keeper).run();
}

}  // namespace billow::cli
