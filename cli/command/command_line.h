// The command line as data: what the table of commands and options says, for what writes it down: the manual page and
// the completions of shells.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace billow::cli {

/// What can stand where an argument is asked for.
struct ArgumentKind {
  enum class Of {
    text,  // anything
    file,  // whose name has one of the endings, or any where there are none
    folder,
    word,        // one of the words
    words,       // several of them, comma-separated
    assignment,  // one of them, "=" and a number
  };
  Of of = Of::text;
  std::vector<std::string_view> words = {};  // or endings: ".yaml"
};

/// An option or, without names, a positional argument.
struct ArgumentEntry {
  std::vector<std::string> names;  // "-o", "--output"
  std::string placeholder;         // of its value, "DIR"; empty: it takes none
  std::string least, most;         // of the value, where it is a number within bounds
  std::string description;
  bool required = false, repeatable = false;
  std::vector<std::string> excludes;  // names of those that cannot stand beside it, in the order of the table
  std::vector<std::string> needs;     // of those that must stand beside it
  ArgumentKind kind;

  bool takes_value() const { return !placeholder.empty(); }
};

/// A command, or, by the name of the program, what stands before any.
struct CommandEntry {
  std::string name, description;
  std::vector<ArgumentEntry> positionals, options;
};

struct CommandLine {
  CommandEntry program;
  std::vector<CommandEntry> commands;
};

/// All of `program` that its help shows. Throws std::logic_error at a placeholder of which nothing says what can stand
/// there.
CommandLine describe_command_line(const CLI::App& program);

}  // namespace billow::cli
