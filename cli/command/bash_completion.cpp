// bash: a table of what each command takes, and a function that goes by it.
#include <fmt/format.h>

#include "cli/command/completions.h"

namespace billow::cli {

namespace {

// How _billow_value, below, is asked for what can stand for an argument.
std::string bash_kind(const ArgumentKind& kind) {
  std::string call;
  switch (kind.of) {
    case ArgumentKind::Of::text:
      return "text";
    case ArgumentKind::Of::folder:
      return "folder";
    case ArgumentKind::Of::file:
      call = "file";
      break;
    case ArgumentKind::Of::word:
      call = "word";
      break;
    case ArgumentKind::Of::words:
      call = "words";
      break;
    case ArgumentKind::Of::assignment:
      call = "assignment";
      break;
  }
  for (const std::string_view word : kind.words) call += fmt::format(" {}", word);
  return call;
}

std::string bash_names(const ArgumentEntry& option, std::string_view between) {
  return fmt::format("{}", fmt::join(option.names, between));
}

std::string bash_command(const CommandEntry& command) {
  std::string flags, values, places;
  for (const ArgumentEntry& option : command.options) {
    flags += (flags.empty() ? "" : " ") + bash_names(option, " ");
    if (option.takes_value())
      values += fmt::format("        {}) value='{}' ;;\n", bash_names(option, " | "), bash_kind(option.kind));
  }
  for (const ArgumentEntry& positional : command.positionals)
    places += fmt::format("{}'{}'", places.empty() ? "" : " ", bash_kind(positional.kind));
  std::string text = fmt::format("    {})\n      flags='{}' places=({})\n", command.name, flags, places);
  if (!values.empty()) text += "      case $1 in\n" + values + "      esac\n";
  return text + "      ;;\n";
}

constexpr std::string_view bash_engine = R"bash(
# _billow_value CURRENT KIND [WORD...]: what a value of that kind can be.
_billow_value() {
  local cur=$1 kind=$2 before='' left='' endings='' entry ending
  shift 2
  case $kind in
    word) mapfile -t COMPREPLY < <(compgen -W "$*" -- "$cur") ;;
    words)
      [[ $cur == *,* ]] && before=${cur%,*},
      for entry; do
        [[ ,$before == *,"$entry",* ]] || left+=" $entry"
      done
      mapfile -t COMPREPLY < <(compgen -P "$before" -W "$left" -- "${cur##*,}")
      compopt -o nospace 2>/dev/null
      ;;
    assignment)
      mapfile -t COMPREPLY < <(compgen -S = -W "$*" -- "$cur")
      compopt -o nospace 2>/dev/null
      ;;
    folder)
      # The package bash-completion knows of quotes and ~.
      if declare -F _filedir >/dev/null; then
        _filedir -d
        return
      fi
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$cur")
      ;;
    file)
      if declare -F _filedir >/dev/null; then
        for ending; do endings+=${endings:+|}${ending#.}; done
        _filedir ${endings:+"@($endings)"}
        return
      fi
      compopt -o filenames 2>/dev/null
      while IFS= read -r entry; do
        if [[ -d $entry || $# == 0 ]]; then COMPREPLY+=("$entry"); fi
        [[ -d $entry ]] && continue
        for ending; do
          if [[ ${entry,,} == *"$ending" ]]; then COMPREPLY+=("$entry"); fi
        done
      done < <(compgen -f -- "$cur")
      ;;
  esac
}

_billow() {
  local cur=${COMP_WORDS[COMP_CWORD]} last=${COMP_WORDS[COMP_CWORD-1]}
  local command='' flags='' value='' places=() word place=0 k
  COMPREPLY=()
  # bash takes --option=value for three words.
  if [[ $cur == = ]]; then
    cur=''
  elif [[ $last == = ]]; then
    last=${COMP_WORDS[COMP_CWORD-2]}
  fi
  [[ ${COMP_WORDS[*]:COMP_CWORD-1:2} != *=* || $last == -* ]] || return 0  # an equals sign of a value's own
  for ((k = 1; k < COMP_CWORD; ++k)); do
    word=${COMP_WORDS[k]}
    if [[ ! $command ]]; then
      [[ $word == -* ]] || command=$word
      continue
    fi
    value='' && _billow_command "$word" "$command"
    if [[ $value ]]; then
      if [[ ${COMP_WORDS[k+1]} == = ]]; then ((++k)); fi
      ((++k))
    elif [[ $word != -* ]]; then
      ((++place))
    fi
  done
  value='' && _billow_command "$last" "$command"
  [[ $value || $cur == -* ]] || value=${places[place]}
  if [[ $value ]]; then
    # shellcheck disable=SC2086  # a kind and its words
    _billow_value "$cur" $value
  elif [[ ! $command && $cur != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$_billow_commands" -- "$cur")
  else
    mapfile -t COMPREPLY < <(compgen -W "$flags" -- "$cur")
  fi
}

complete -F _billow billow
)bash";

}  // namespace

std::string bash_completion(const CommandLine& line) {
  std::string names, table;
  for (const CommandEntry& command : line.commands) {
    names += (names.empty() ? "" : " ") + command.name;
    table += bash_command(command);
  }
  CommandEntry before = line.program;
  before.name = "''";
  return fmt::format(
      "# bash completion of billow, as `billow generate bash` writes it.\n\n"
      "_billow_commands='{}'\n\n"
      "# _billow_command OPTION COMMAND: the flags of the command, what its places take, and the option's value.\n"
      "_billow_command() {{\n  case $2 in\n{}{}  esac\n}}\n{}",
      names, bash_command(before), table, bash_engine);
}

}  // namespace billow::cli
