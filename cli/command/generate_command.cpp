// billow generate: what a package installs beside the tool.
#include "cli/command/application.h"
#include "cli/command/command_line.h"
#include "cli/command/commands.h"
#include "cli/command/completions.h"
#include "cli/command/manual_page.h"
#include "cli/text/terminal.h"

namespace billow::cli {

namespace {

struct GeneratedRow {
  std::string_view name;
  Generated generated;
  std::string (*text)(const CommandLine& line);
};

constexpr GeneratedRow generated_rows[] = {
    {"man", Generated::man, manual_page},
    {"bash", Generated::bash, bash_completion},
    {"zsh", Generated::zsh, zsh_completion},
    {"fish", Generated::fish, fish_completion},
};

}  // namespace

Words<Generated> words(Generated) {
  static constexpr auto words = words_of(generated_rows, &GeneratedRow::name, &GeneratedRow::generated);
  return words;
}

int generate_command(Generated what, const CLI::App& program) {
  print_text(row_for(generated_rows, &GeneratedRow::generated, what).text(describe_command_line(program)));
  return exit_done;
}

}  // namespace billow::cli
