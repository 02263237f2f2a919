// Child processes with their output in files.
#include "tests/support/tool.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <thread>

namespace billow::test {

namespace fs = std::filesystem;

namespace {

void redirect(const fs::path& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(opened, descriptor);
  close(opened);
}

[[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments, const fs::path& folder,
                         const fs::path& out, const fs::path& err) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  signal(SIGINT, SIG_DFL);  // tests that run in the background are handed on that it is ignored
  if (chdir(folder.c_str()) == 0) execvp(program.c_str(), argv.data());
  _exit(127);
}

}  // namespace

ToolResult run_program(const std::string& program, const std::vector<std::string>& arguments, const fs::path& folder,
                       double interrupt_after, const fs::path& interrupt_when) {
  const fs::path out = folder / "stdout.txt", err = folder / "stderr.txt";
  const pid_t child = fork();
  if (child == 0) become(program, arguments, folder, out, err);
  if (interrupt_after >= 0.0) {
    for (int k = 0; k < 6000 && !interrupt_when.empty() && !fs::exists(interrupt_when); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::duration<double>(interrupt_after));
    kill(child, SIGINT);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ToolResult result{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_text(out), read_text(err)};
  fs::remove(out);
  fs::remove(err);
  return result;
}

ToolResult run_tool(const std::vector<std::string>& arguments, const fs::path& folder, double interrupt_after,
                    const fs::path& interrupt_when) {
  return run_program(BILLOW_TOOL, arguments, folder, interrupt_after, interrupt_when);
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace billow::test
