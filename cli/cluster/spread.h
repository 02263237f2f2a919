// Work that other processes do, on this machine or on many: the commands for it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billow::cli {

/// What a line of a shell is made of.
using CommandWords = std::vector<std::string>;

/// How a command's work is handed to others.
struct SpreadOptions {
  bool commands = false;            // print a line for each piece
  bool slurm = false;               // print a script that submits them
  bool submit = false;              // run that script
  bool video = false;               // of frames: a film in the end
  bool untrusted = false;           // handed on
  std::string backend;              // handed on where the user has named one
  int array_limit = 16;             // tasks that Slurm runs at a time
  int chunk = 0;                    // runs or frames a task; 0: as suits the work
  std::vector<std::string> sbatch;  // further options, each a line
  bool any() const { return commands || slurm; }
};

/// What is wrong with a line of further options for sbatch: nothing where it can stand in the script.
std::optional<std::string> sbatch_fault(std::string_view line);

/// `numbers`, ascending, as lists of `chunk` each: "1-3,7".
std::vector<std::string> lists_of(const std::vector<long>& numbers, int chunk);

/// How many of `count` pieces a task takes, where `wanted` is 0 as many as make at most `tasks`; also of a large count
/// no more than the 1000 that Slurm lets an array have by default. Says so where `wanted` makes more.
int pieces_a_task(std::size_t count, int wanted, std::size_t tasks);

/// The words as a shell takes them, in one line. Throws InputError where one holds what a line of commands cannot: line
/// ends, control characters, bytes that are no UTF-8.
std::string shell_line(const std::vector<std::string>& words);

/// The path of this very program.
std::string this_program();

}  // namespace billow::cli
