// fish: one `complete` for each command, option and place.
#include <fmt/format.h>

#include "cli/command/completions.h"

namespace billow::cli {

namespace {

// Within single quotes.
std::string fish_text(std::string_view text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted;
}

constexpr const char* fish_any_file = " -F";

// What completes a value, as options of `complete`.
std::string fish_value(const ArgumentKind& kind) {
  switch (kind.of) {
    case ArgumentKind::Of::text:
      return "";
    case ArgumentKind::Of::folder:
      return " -a '(__fish_complete_directories (commandline -ct))'";
    case ArgumentKind::Of::word:
      return fmt::format(" -a '{}'", fmt::join(kind.words, " "));
    case ArgumentKind::Of::words:
      return fmt::format(" -a '(__fish_append , {})'", fmt::join(kind.words, " "));
    case ArgumentKind::Of::assignment:
      return fmt::format(" -a '{}='", fmt::join(kind.words, "= "));
    case ArgumentKind::Of::file:
      break;
  }
  if (kind.words.empty()) return fish_any_file;
  return fmt::format(" -a '(__billow_files {})'", fmt::join(kind.words, " "));
}

std::string fish_option(const ArgumentEntry& option, const std::string& condition) {
  std::string text = fmt::format("complete -c billow -n '{}'", condition);
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.takes_value()) {
    const std::string value = fish_value(option.kind);
    text += (value == fish_any_file ? " -r" : " -x") + value;
  }
  return text + fmt::format(" -d '{}'\n", fish_text(option.description));
}

std::string fish_command(const CommandEntry& command) {
  const std::string within = "__fish_seen_subcommand_from " + command.name;
  std::string text = fmt::format("\ncomplete -c billow -n __fish_use_subcommand -a {} -d '{}'\n", command.name,
                                 fish_text(command.description));
  for (const ArgumentEntry& option : command.options) text += fish_option(option, within);
  for (const ArgumentEntry& positional : command.positionals) {
    text += fmt::format("complete -c billow -n '{}'{} -d '{}'\n", within, fish_value(positional.kind),
                        fish_text(positional.description));
  }
  return text;
}

constexpr std::string_view fish_files = R"fish(
function __billow_files -d 'Folders, and files with one of these endings'
    set -l endings (string join '|' -- (string escape --style=regex -- $argv))
    __fish_complete_path (commandline -ct) | string replace -r '\t.*' '' | string match -ri ".*(/|$endings)\$"
end

complete -c billow -f
)fish";

}  // namespace

std::string fish_completion(const CommandLine& line) {
  std::string text = "# fish completion of billow, as `billow generate fish` writes it.\n" + std::string(fish_files);
  for (const ArgumentEntry& option : line.program.options) text += fish_option(option, "__fish_use_subcommand");
  for (const CommandEntry& command : line.commands) text += fish_command(command);
  return text;
}

}  // namespace billow::cli
