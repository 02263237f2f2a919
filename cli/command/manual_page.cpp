// Commands and options from their table, between what is said of the tool as a whole.
#include "cli/command/manual_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/utf8.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

// Text as roff reads it: what stands at the beginning of a line could be a request, "-" alone would be a hyphen.
std::string roff(std::string_view text) {
  std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  while (!text.empty()) {
    const auto [point, bytes] = first_character(text);
    if (point == '\\')
      out += "\\e";
    else if (point == '-')
      out += "\\-";
    else if (point == '\'')
      out += "\\(aq";
    else if (point < 0x80)
      out += static_cast<char>(point);
    else
      out += fmt::format("\\[u{:04X}]", static_cast<unsigned>(point));
    text.remove_prefix(static_cast<std::size_t>(std::max(bytes, 1)));
  }
  return out;
}

std::string bold(std::string_view text) { return fmt::format("\\fB{}\\fR", roff(text)); }
std::string italic(std::string_view text) { return fmt::format("\\fI{}\\fR", roff(text)); }

// "-o DIR, --output DIR"
std::string option_heading(const ArgumentEntry& option) {
  std::string heading;
  for (const std::string& name : option.names) {
    heading += (heading.empty() ? "" : ", ") + bold(name);
    if (option.takes_value()) heading += " " + italic(option.placeholder);
  }
  return heading;
}

// " Not with --resume or --from."
std::string rule(std::string_view words, std::string_view between, const std::vector<std::string>& options) {
  std::string text;
  for (const std::string& option : options) text += fmt::format(" {} {}", text.empty() ? words : between, bold(option));
  return text.empty() ? text : text + ".";
}

// What the description leaves to the table: "From 1 to 256. Needs --slurm. Not with --resume."
std::string option_rules(const ArgumentEntry& option) {
  std::string rules;
  if (!option.least.empty()) rules += fmt::format(" From {} to {}.", roff(option.least), roff(option.most));
  return rules + rule("Needs", "and", option.needs) + rule("Not with", "or", option.excludes);
}

std::string described(const ArgumentEntry& argument, const std::string& heading) {
  std::string text = roff(argument.description);
  if (!text.ends_with('.')) text += '.';
  return fmt::format(".TP\n{}\n{}{}\n", heading, text, option_rules(argument));
}

std::string synopsis(const CommandEntry& command) {
  std::string line = bold("billow") + " " + bold(command.name);
  for (const ArgumentEntry& positional : command.positionals) line += " " + italic(positional.placeholder);
  if (!command.options.empty()) line += " [" + italic("OPTION") + "]...";
  return line;
}

// Those that every command has are told of once.
bool has_option(const CommandEntry& command, const ArgumentEntry& option) {
  return std::any_of(command.options.begin(), command.options.end(),
                     [&](const ArgumentEntry& other) { return other.names == option.names; });
}

std::string command_section(const CommandEntry& command, const CommandEntry& program) {
  std::string text = fmt::format(".SS {}\n{}.\n", synopsis(command), roff(command.description));
  for (const ArgumentEntry& positional : command.positionals)
    text += described(positional, italic(positional.placeholder));
  for (const ArgumentEntry& option : command.options)
    if (!has_option(program, option)) text += described(option, option_heading(option));
  return text;
}

// "--help | --version [--json]": what needs another stands behind it.
std::string flags_of(const CommandEntry& program) {
  std::string flags;
  for (const ArgumentEntry& option : program.options) {
    if (!option.needs.empty()) continue;
    flags += (flags.empty() ? "" : " | ") + bold(option.names.back());
    for (const ArgumentEntry& other : program.options)
      if (other.needs == std::vector{option.names.back()}) flags += fmt::format(" [{}]", bold(other.names.back()));
  }
  return flags;
}

struct StatusRow {
  std::string_view status, meaning;
};

// ExitStatus, and what a signal makes of it.
constexpr StatusRow statuses[] = {
    {"0", "Done."},
    {"1", "An internal fault, or no memory."},
    {"2", "Wrong arguments."},
    {"3", "Images differ."},
    {"4", "Bad input: the message says where, what is wrong and what to do."},
    {"5", "The simulation diverged."},
    {"6", "An output could not be written."},
    {"129, 130, 143", "Stopped by a signal; what was written is whole, and --resume goes on from it."},
};

constexpr std::string_view description = R"(.SH DESCRIPTION
.B billow
simulates cloth and fish as filtered mass-spring systems from scene files in YAML, and renders them offscreen to PNG:
textured and velocity-coloured frames, velocity-evolution strips, certified step limits.
It needs neither a display nor a graphics card.
.PP
Data goes to stdout, progress and messages to stderr.
A file appears under its name only when it is whole.
The same scene gives the same bytes with any number of threads.
)";

constexpr std::string_view after_commands = R"(.SH ENVIRONMENT
.TP
.B BILLOW_BACKEND
What draws where
.B --backend
does not say.
.TP
.B LP_NUM_THREADS
Threads of the software rasteriser, in place of as many as
.B --threads
says or there are cores, but at most 16.
The pictures do not depend on it.
.TP
.B CI
Where it is set,
.B billow compare \-\-accept
accepts no images and
.B billow golden \-\-update
no baselines.
.SH FILES
.TP
.I share/billow/scenes
Scenes and studies that can be rendered as they are, and
.IR scene.schema.json ,
by which editors complete and check a scene.
The meshes and textures that they name are in
.IR share/billow/assets .
Both are below where billow is installed, /usr for a package.
.TP
.I out
Below the working folder: where a run is written to without
.BR \-o .
.SH EXAMPLES
.TP
.B billow render /usr/share/billow/scenes/drape.yaml
Writes 250 frames of each view, the strip, the record and the page
.I index.html
to
.IR out/drape .
.TP
.B billow render scene.yaml \-D duration=2 \-D solver.method=verlet \-o short
Another duration and method than the file says.
.TP
.B billow stability scene.yaml
Prints the largest stable step of every method, with and without the filter.
.TP
.B billow compare baselines out/drape/textured \-\-report differences
Compares two folders of images, and writes a page of what differs.
.SH SEE ALSO
.BR gnuplot (1),
.BR ffmpeg (1)
.PP
What a scene and a study can say, and the method with its equations, stand in
.IR share/doc/billow/docs .
)";

}  // namespace

std::string manual_page(const CommandLine& line) {
  std::string page = fmt::format(".TH BILLOW 1 \"\" \"billow {}\" \"User Commands\"\n.SH NAME\nbillow \\- {}\n",
                                 roff(version()), roff(line.program.description));
  page += ".SH SYNOPSIS\n";
  for (const CommandEntry& command : line.commands) page += synopsis(command) + "\n.br\n";
  page += fmt::format("{} {}\n{}", bold("billow"), flags_of(line.program), description);
  page += ".SH OPTIONS\nEvery command has help of its own.\n";
  for (const ArgumentEntry& option : line.program.options) page += described(option, option_heading(option));
  page += ".SH COMMANDS\n";
  for (const CommandEntry& command : line.commands) page += command_section(command, line.program);
  page += ".SH EXIT STATUS\n";
  for (const StatusRow& row : statuses) page += fmt::format(".TP\n{}\n{}\n", bold(row.status), roff(row.meaning));
  return page + std::string(after_commands);
}

}  // namespace billow::cli
