// A shell script that submits jobs to Slurm, one after the other.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/cluster/spread.h"

namespace billow::cli {

struct SlurmJob {
  std::string name;                // a word: of the job, its log and the script's variable
  std::string about;               // a comment
  std::string after;               // "afterok:simulate": the job that it waits for, and for what end; empty: for none
  std::vector<std::string> tasks;  // of an array: what each task does; empty: one job
  std::vector<std::string> lines;  // of the shell; the last of a job that can be stopped is stopped and begun again
  bool can_be_stopped = false;     // and goes on where it was: Slurm queues it again when its time is up
  bool alone = false;              // it wants its node to itself
};

struct SlurmScript {
  std::string about;                           // comments, as lines
  std::string title;                           // of the jobs
  std::filesystem::path output;                // what the jobs write to; their logs lie beside it
  std::vector<std::filesystem::path> folders;  // which jobs find there
  int threads = 0;                             // of each job; 0: one
  std::vector<SlurmJob> jobs;
};

/// In a job's lines: this program, the piece of an array's task, and how many threads it has.
inline constexpr const char *job_program = "\"$billow\"", *job_piece = "\"${tasks[SLURM_ARRAY_TASK_ID]}\"",
                            *job_threads = "--threads \"$SLURM_CPUS_PER_TASK\"";

/// The script. Throws InputError as shell_line.
std::string text_of(const SlurmScript& script, const SpreadOptions& options);

/// Prints the script, or writes it beside the jobs' logs, runs it and prints what it says. Throws OutputError when it
/// cannot be written or Slurm takes no jobs.
void hand_over(const SlurmScript& script, const SpreadOptions& options);

}  // namespace billow::cli
