// Pieces of work and the lines that do them.
#include "cli/cluster/spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "cli/run/frame_list.h"
#include "cli/text/command_text.h"
#include "cli/text/terminal.h"

namespace billow::cli {

namespace {

constexpr std::size_t most_tasks = 1000;  // Slurm's MaxArraySize is 1001 where nobody has set it

// What the script's jobs are made of.
bool is_set_by_script(std::string_view word) {
  // sbatch takes the beginnings of names for them.
  const std::string_view given = word.substr(0, word.find('='));
  for (const std::string_view name : {"--array", "--chdir", "--dependency", "--wrap", "--parsable"})
    if (given.size() > 3 && name.starts_with(given)) return true;
  return word.starts_with("-a") || word.starts_with("-d") || word.starts_with("-D");
}

}  // namespace

std::optional<std::string> sbatch_fault(std::string_view line) {
  if (printable(line) != line) return "holds characters that a line of a script cannot";
  std::istringstream words{std::string(line)};
  std::string word;
  if (!(words >> word)) return "is empty";
  if (!word.starts_with('-')) return fmt::format("'{}' is no option like --time=2:00:00", word);
  do {
    if (is_set_by_script(word)) return fmt::format("{} is what the script itself sets", word);
  } while (words >> word);
  return std::nullopt;
}

std::vector<std::string> lists_of(const std::vector<long>& numbers, int chunk) {
  std::vector<std::string> lists;
  const auto size = static_cast<std::size_t>(chunk);
  for (std::size_t begin = 0; begin < numbers.size(); begin += size) {
    const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(begin);
    const std::size_t count = std::min(size, numbers.size() - begin);
    lists.push_back(list_text(std::vector<long>(first, first + static_cast<std::ptrdiff_t>(count))));
  }
  return lists;
}

int pieces_a_task(std::size_t count, int wanted, std::size_t tasks) {
  if (wanted > 0) {
    if (count > most_tasks * static_cast<std::size_t>(wanted))
      say_line(
          "warning: more than {} tasks, which Slurm refuses unless its MaxArraySize is larger; a --chunk of {} makes "
          "fewer",
          most_tasks, (count + most_tasks - 1) / most_tasks);
    return wanted;
  }
  const std::size_t most = std::clamp<std::size_t>(tasks, 1, most_tasks);
  return static_cast<int>(std::max<std::size_t>(1, (count + most - 1) / most));
}

std::string shell_line(const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (printable(word) != word)
      throw InputError(fmt::format("{}: holds characters that a line of commands cannot; rename it", word));
  return command_line(words);
}

std::string this_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

}  // namespace billow::cli
