// zsh: one _arguments for each command.
#include <fmt/format.h>

#include "cli/command/completions.h"

namespace billow::cli {

namespace {

// `text` within single quotes, and within what _arguments takes apart at colons and brackets.
std::string zsh_text(std::string_view text) {
  std::string quoted;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']' || c == '\\') quoted += '\\';
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted;
}

// What completes a value, as _arguments has it after the second colon.
std::string zsh_action(const ArgumentEntry& argument) {
  const auto& words = argument.kind.words;
  switch (argument.kind.of) {
    case ArgumentKind::Of::text:
      return " ";
    case ArgumentKind::Of::folder:
      return "_files -/";
    case ArgumentKind::Of::word:
      return fmt::format("({})", fmt::join(words, " "));
    case ArgumentKind::Of::words:
      return fmt::format("_values -s , {} {}", zsh_text(argument.placeholder), fmt::join(words, " "));
    case ArgumentKind::Of::assignment:
      return fmt::format("compadd -S \"=\" - {}", fmt::join(words, " "));
    case ArgumentKind::Of::file:
      break;
  }
  if (words.empty()) return "_files";
  std::string endings;
  for (const std::string_view ending : words) endings += (endings.empty() ? "" : "|") + std::string(ending.substr(1));
  return fmt::format("_files -g \"*.({})(-.)\"", endings);
}

std::string zsh_value(const ArgumentEntry& argument) {
  return fmt::format(":{}:{}", zsh_text(argument.placeholder), zsh_action(argument));
}

// An option's names exclude each other too, unless it can be repeated.
std::string zsh_option(const ArgumentEntry& option) {
  std::vector<std::string> excluded = option.excludes;
  if (!option.repeatable) excluded.insert(excluded.end(), option.names.begin(), option.names.end());
  std::string spec;
  if (!excluded.empty()) spec = fmt::format("'({})'", fmt::join(excluded, " "));
  if (option.repeatable) spec += "'*'";
  std::vector<std::string> names;
  for (const std::string& name : option.names)
    names.push_back(!option.takes_value() ? name : name.starts_with("--") ? name + "=" : name + "+");
  spec += names.size() == 1 ? names[0] : fmt::format("{{{}}}", fmt::join(names, ","));
  return spec + fmt::format("'[{}]{}'", zsh_text(option.description), option.takes_value() ? zsh_value(option) : "");
}

std::string zsh_arguments(const CommandEntry& command) {
  std::string text;
  for (const ArgumentEntry& option : command.options) text += " \\\n        " + zsh_option(option);
  for (std::size_t p = 0; p < command.positionals.size(); ++p)
    text += fmt::format(" \\\n        '{}{}'", p + 1, zsh_value(command.positionals[p]));
  return text;
}

}  // namespace

std::string zsh_completion(const CommandLine& line) {
  std::string names, cases;
  for (const CommandEntry& command : line.commands) {
    names += fmt::format("    '{}:{}'\n", command.name, zsh_text(command.description));
    cases +=
        fmt::format("    {})\n      _arguments -s -S{} && ret=0\n      ;;\n", command.name, zsh_arguments(command));
  }
  return fmt::format(
      "#compdef billow\n"
      "# zsh completion of billow, as `billow generate zsh` writes it.\n\n"
      "_billow_commands() {{\n  local -a commands=(\n{}  )\n  _describe -t commands command commands\n}}\n\n"
      "_billow() {{\n"
      "  local curcontext=$curcontext state line ret=1\n"
      "  typeset -A opt_args\n"
      "  _arguments -C -s -S{} \\\n        '1:command:_billow_commands' '*:: :->arguments' && ret=0\n"
      "  [[ $state == arguments ]] || return ret\n"
      "  curcontext=${{curcontext%:*:*}}:billow-$words[1]:\n"
      "  case $words[1] in\n{}  esac\n"
      "  return ret\n}}\n\n"
      "if [[ $funcstack[1] == _billow ]]; then _billow \"$@\"; else compdef _billow billow; fi\n",
      names, zsh_arguments(line.program), cases);
}

}  // namespace billow::cli
