// Starting children, waiting for them, and ending them together.
#include "cli/study/study_jobs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <map>
#include <system_error>
#include <thread>

#include "base/error.h"
#include "cli/run/interrupt.h"

extern char** environ;

namespace billow::cli {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds look_again{20};

/// What posix_spawn needs, released with it.
class SpawnSetup {
 public:
  explicit SpawnSetup(const std::string& log) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    // A new file: what another has put there, perhaps a link to somewhere else, is not written to.
    unlink(log.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW,
                                     0666);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_init(&attributes_);
    // A group of its own: Ctrl-C at the terminal reaches this process alone, which hands it on once.
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSetup() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSetup(const SpawnSetup&) = delete;
  SpawnSetup& operator=(const SpawnSetup&) = delete;

  pid_t spawn(const std::vector<std::string>& words) const {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t child = 0;
    const int error = posix_spawn(&child, "/proc/self/exe", &actions_, &attributes_, arguments.data(), environ);
    if (error != 0) throw std::system_error(error, std::generic_category(), "cannot start a run of the study");
    return child;
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

int exit_status(int wait_status) {
  return WIFSIGNALED(wait_status) ? 128 + WTERMSIG(wait_status) : WEXITSTATUS(wait_status);
}

/// The children that are running.
class Children {
 public:
  std::size_t count() const { return running_.size(); }

  void start(int number, const std::vector<std::string>& words, const std::string& log) {
    running_[SpawnSetup(log).spawn(words)] = {number, Clock::now()};
  }

  /// Waits a moment; the ends of those that have ended meanwhile.
  std::vector<JobEnd> wait_a_moment() {
    std::vector<JobEnd> ends;
    for (auto child = running_.begin(); child != running_.end();) {
      int status = 0;
      if (waitpid(child->first, &status, WNOHANG) == child->first) {
        const double seconds = std::chrono::duration<double>(Clock::now() - child->second.second).count();
        ends.push_back({child->second.first, exit_status(status), seconds});
        child = running_.erase(child);
      } else {
        ++child;
      }
    }
    if (ends.empty()) std::this_thread::sleep_for(look_again);
    return ends;
  }

  void signal_all(int signal) {
    for (const auto& [child, run] : running_) kill(child, signal);
  }

 private:
  std::map<pid_t, std::pair<int, Clock::time_point>> running_;
};

}  // namespace

void run_jobs(const std::vector<std::string>& command, const std::vector<int>& numbers, int jobs,
              const std::function<std::filesystem::path(int)>& log_of,
              const std::function<void(const JobEnd&)>& ended) {
  Children children;
  std::size_t next = 0;
  bool handed_on = false;
  while (next < numbers.size() || children.count() > 0) {
    const bool stop = interrupted_by() != 0;
    if (stop && children.count() == 0) return;
    if (stop && !handed_on) children.signal_all(interrupted_by()), handed_on = true;
    while (!stop && next < numbers.size() && static_cast<int>(children.count()) < jobs) {
      const int number = numbers[next++];
      std::vector<std::string> words = command;
      words.insert(words.end(), {"--only", std::to_string(number)});
      children.start(number, words, log_of(number).string());
    }
    for (const JobEnd& end : children.wait_a_moment()) ended(end);
  }
}

}  // namespace billow::cli
