// Every job is a script of its own, which sbatch reads from the submitting one.
#include "cli/cluster/slurm_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/atomic_file.h"
#include "base/child_process.h"
#include "base/error.h"
#include "cli/run/output_folder.h"
#include "cli/text/terminal.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t line_width = 100;
constexpr const char* end_of_job = "END_OF_JOB";

// Beside the jobs' output, where nothing but results belongs.
fs::path log_folder(const SlurmScript& script) {
  fs::path folder = script.output.lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  folder += "-slurm";
  return folder;
}

// Slurm writes numbers in place of %A and its like.
std::string without_percent(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

std::string directives(const SlurmScript& script, const SlurmJob& job, const SpreadOptions& options) {
  const std::string log = without_percent((log_folder(script) / job.name).string());
  std::string text = fmt::format("#SBATCH --job-name={}\n", shell_line({script.title + "-" + job.name}));
  text += fmt::format("#SBATCH --output={}\n", shell_line({log + (job.tasks.empty() ? "-%j.txt" : "-%A_%a.txt")}));
  text += fmt::format("#SBATCH --open-mode=append\n#SBATCH --cpus-per-task={}\n", std::max(1, script.threads));
  if (job.can_be_stopped) text += "#SBATCH --requeue\n#SBATCH --signal=B:USR1@120\n";
  if (job.alone) text += "#SBATCH --exclusive\n";
  for (const std::string& line : options.sbatch) text += fmt::format("#SBATCH {}\n", line);
  if (!job.tasks.empty()) text += fmt::format("#SBATCH --array=0-{}%{}\n", job.tasks.size() - 1, options.array_limit);
  // What waits for an end that does not come would wait for ever.
  if (job.after.starts_with("afterok:")) text += "#SBATCH --kill-on-invalid-dep=yes\n";
  return text;
}

std::string list_of_tasks(const std::vector<std::string>& tasks) {
  std::string text = "tasks=(", line;
  for (const std::string& task : tasks) {
    if (line.size() + task.size() > line_width) text += "\n " + line, line.clear();
    line += " " + task;
  }
  return text + "\n " + line + "\n)\n";
}

// The shell takes the notice and waits again for what ends because of it.
constexpr const char* stoppable =
    R"(# Slurm's notice before the time is up: what runs stops cleanly, and the job is queued again and goes on from there.
trap 'stopped=yes; kill -TERM $tool' USR1
{} &
tool=$!
wait $tool && status=0 || status=$?
if [ -n "${{stopped-}}" ]; then
  wait $tool && status=0 || status=$?
  if [ $status -ge 128 ] && [ "${{SLURM_RESTART_COUNT:-0}}" -lt 100 ]; then exec scontrol requeue "$SLURM_JOB_ID"; fi
fi
)";

std::string body(const SlurmJob& job) {
  std::string text = fmt::format("# {}\nbillow={}\n", job.about, shell_line({this_program()}));
  if (!job.tasks.empty()) text += list_of_tasks(job.tasks);
  if (job.can_be_stopped) {
    text += fmt::format(fmt::runtime(stoppable), job.lines.front());
    for (std::size_t k = 1; k < job.lines.size(); ++k) text += job.lines[k] + "\n";
    return text + "exit $status\n";
  }
  text += "set -e\ntrap '' USR1\n";
  for (const std::string& line : job.lines) text += line + "\n";
  return text;
}

// "afterok:simulate" -> " --dependency="afterok:${simulate%%;*}"": sbatch may say the cluster behind the job.
std::string dependency(const SlurmJob& job) {
  if (job.after.empty()) return "";
  const std::size_t colon = job.after.find(':');
  return fmt::format(" --dependency=\"{}:${{{}%%;*}}\"", job.after.substr(0, colon), job.after.substr(colon + 1));
}

std::string submission(const SlurmScript& script, const SlurmJob& job, const SpreadOptions& options) {
  return fmt::format("\n{}=$(sbatch --parsable{} <<'{}'\n#!/usr/bin/env bash\n{}{}{}\n)\n", job.name, dependency(job),
                     end_of_job, directives(script, job, options), body(job), end_of_job);
}

// The first line of what the shell or sbatch complained of.
std::string complaint_of(const ProgramResult& result) {
  if (!result.found) return "there is no bash";
  const std::string first = result.errors.substr(0, result.errors.find('\n'));
  return first.empty() ? fmt::format("exit status {}", result.status) : first;
}

}  // namespace

std::string text_of(const SlurmScript& script, const SpreadOptions& options) {
  std::string text = fmt::format("#!/usr/bin/env bash\n{}# Written by billow {}; submit it with `bash FILE`.\n",
                                 script.about, version());
  text += fmt::format("set -euo pipefail\ncd {}\n", shell_line({fs::current_path().string()}));
  std::vector<std::string> folders = {"mkdir", "-p", log_folder(script).string()};
  for (const fs::path& folder : script.folders) folders.push_back(folder.string());
  text += shell_line(folders) + "\n";
  std::string submitted;
  for (const SlurmJob& job : script.jobs) {
    text += submission(script, job, options);
    submitted += fmt::format("{}{} ${}", submitted.empty() ? "" : ", ", job.name, job.name);
  }
  return text + fmt::format("\necho \"submitted: {}\"\n", submitted);
}

void hand_over(const SlurmScript& script, const SpreadOptions& options) {
  const std::string text = text_of(script, options);
  if (!options.submit) return print_text(text);
  const fs::path file = log_folder(script) / "submit.sh";
  make_folder(log_folder(script));
  write_file_atomically(file, text);
  const ProgramResult result = run_program({"bash", file.string()}, "", std::numeric_limits<double>::infinity());
  if (result.status == 127)
    throw OutputError(fmt::format("there is no sbatch here; on a machine that submits to Slurm: bash {}",
                                  shell_line({file.string()})));
  if (!result.found || result.status != 0)
    throw OutputError(fmt::format("{} was not taken: {}", file.string(), complaint_of(result)));
  print_text(result.output);
  say_line("the script is {}, the jobs' logs lie beside it", file.string());
}

}  // namespace billow::cli
