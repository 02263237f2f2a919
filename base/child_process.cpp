// posix_spawn, with files in memory as its stdin, stdout and stderr, so that neither side can block on a pipe.
#include "base/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

extern char** environ;

namespace billow {

namespace {

/// A file without a name, in memory.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("billow", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "no file in memory can be made");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }

  void fill(const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t written = write(descriptor_, text.data() + done, text.size() - done);
      if (written <= 0) throw std::system_error(errno, std::generic_category(), "a file in memory cannot be written");
      done += static_cast<std::size_t>(written);
    }
    lseek(descriptor_, 0, SEEK_SET);
  }

  std::size_t size() const {
    struct stat status = {};
    fstat(descriptor_, &status);
    return static_cast<std::size_t>(status.st_size);
  }

  std::string head(std::size_t most) const { return piece(0, std::min(size(), most)); }
  std::string tail(std::size_t most) const {
    const std::size_t length = std::min(size(), most);
    return piece(size() - length, length);
  }

 private:
  std::string piece(std::size_t begin, std::size_t length) const {
    std::string text(length, '\0');
    std::size_t done = 0;
    while (done < length) {
      const ssize_t got = pread(descriptor_, text.data() + done, length - done, static_cast<off_t>(begin + done));
      if (got <= 0) break;
      done += static_cast<std::size_t>(got);
    }
    text.resize(done);
    return text;
  }

  int descriptor_;
};

// As exec takes them; `words` must outlive them.
std::vector<char*> argument_list(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  return arguments;
}

// The child's process number; 0 when the program does not exist.
pid_t spawn(const std::vector<std::string>& words, const std::string& folder, const MemoryFile& input,
            const MemoryFile& output, const MemoryFile& errors) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.descriptor(), STDERR_FILENO);
  if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  const std::vector<char*> arguments = argument_list(words);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) return 0;
  if (error != 0) throw std::system_error(error, std::generic_category(), "cannot start " + words[0]);
  return child;
}

/// Why a program is ended before it ends itself.
enum class Ending { none, time, watcher };

// Waits for its end, or ends it. Looks 500 times a second at a short program, 20 times at one that is watched.
Ending wait_for(pid_t child, double seconds, const std::function<bool()>& goes_on, int& status) {
  const auto begin = std::chrono::steady_clock::now();
  const std::chrono::milliseconds pause(goes_on ? 50 : 2);
  while (waitpid(child, &status, WNOHANG) == 0) {
    const bool late = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > seconds;
    if (late || (goes_on && !goes_on())) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return late ? Ending::time : Ending::watcher;
    }
    std::this_thread::sleep_for(pause);
  }
  return Ending::none;
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& words, const std::string& input, double seconds,
                          const ProgramWatcher& watcher, const std::string& folder) {
  constexpr std::size_t most_errors = 64 << 10, most_output = 4 << 10;
  MemoryFile in, out, errors;
  in.fill(input);
  ProgramResult result;
  const pid_t child = spawn(words, folder, in, out, errors);
  if (child == 0) {
    result.found = false;
    return result;
  }
  int status = 0;
  std::function<bool()> goes_on;
  if (watcher) goes_on = [&] { return watcher(out.tail(most_output)); };
  const Ending ending = wait_for(child, seconds, goes_on, status);
  result.timed_out = ending == Ending::time;
  result.stopped = ending == Ending::watcher;
  result.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  result.output = out.head(out.size());
  result.errors = errors.head(most_errors);
  return result;
}

void become_program(const std::vector<std::string>& words, const std::string& folder, unsigned seconds) {
  if (chdir(folder.c_str()) != 0) throw std::system_error(errno, std::generic_category(), "cannot work in " + folder);
  // Ignored signals would stay ignored; caught ones go back by themselves.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_DFL);
  alarm(seconds);
  execvp(words[0].c_str(), argument_list(words).data());
  const int error = errno;
  alarm(0);
  throw std::system_error(error, std::generic_category(), "cannot start " + words[0]);
}

}  // namespace billow
