// Arguments, commands, exit status.
#include "cli/command/application.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "base/out_of_memory.h"
#include "base/standard_streams.h"
#include "base/suggest.h"
#include "cli/command/command_options.h"
#include "cli/command/error_report.h"
#include "cli/run/interrupt.h"
#include "cli/text/command_text.h"
#include "cli/text/terminal.h"
#include "cli/text/text_file.h"

namespace billow::cli {

namespace {

std::string typed_command(int argc, char** argv) {
  std::vector<std::string> words = {"billow"};
  words.insert(words.end(), argv + 1, argv + argc);
  return command_line(words);
}

// CLI11 takes a misspelt command for a missing one.
std::optional<std::string> unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return std::nullopt;
  std::vector<std::string_view> known;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == argv[1]) return std::nullopt;
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  return fmt::format("unknown command '{}'{}", shortened(argv[1]), suggestion(argv[1], known, "commands are"));
}

// CLI11 names what is left over from its end, and not what it may have been meant for.
std::string unexpected_arguments(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  std::vector<std::string> left = app.remaining(true);
  const bool has_end_of_options = std::erase(left, "--") > 0;
  std::vector<std::string> quoted;
  for (const std::string& word : left) quoted.push_back(fmt::format("'{}'", shortened(word)));
  std::vector<std::string> known;
  for (const CLI::Option* option : command->get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  const std::string name = command == &app ? "billow" : "billow " + command->get_name();
  if (has_end_of_options)
    return fmt::format("{} does not take {}; what stands behind '--' is no option", name, fmt::join(quoted, ", "));
  const std::string meant(closest_name(left.empty() ? "" : left.front(), {known.begin(), known.end()}));
  return fmt::format(
      "{} does not take {}; {}", name, fmt::join(quoted, ", "),
      meant.empty() ? fmt::format("'{} --help' lists what it takes", name) : fmt::format("did you mean '{}'?", meant));
}

/// Says errors: to people, or with --progress json to programs, also of arguments that are wrong themselves.
class ErrorReport {
 public:
  ErrorReport(int argc, char** argv) : arguments_(argv + std::min(argc, 1), argv + argc) {
    for (std::size_t k = 0; k < arguments_.size(); ++k)
      if (arguments_[k] == "--progress=json" || (arguments_[k] == "json" && k > 0 && arguments_[k - 1] == "--progress"))
        as_json_ = true;
  }

  int operator()(std::string_view message, int status) const {
    if (as_json_)
      say_json(error_json(message, status, arguments_));
    else
      say_message(message);
    return status;
  }

  // What CLI11 says of arguments, with its own next step in a second line.
  int usage(const CLI::ParseError& error, const std::string& text) const {
    if (!as_json_) return say_text(text), exit_usage;
    const std::string message = error.what();
    return (*this)(message.find("; ") != message.npos ? message : message + "; run with --help for more information",
                   exit_usage);
  }

 private:
  std::vector<std::string> arguments_;
  bool as_json_ = false;
};

int run_command(const std::function<int()>& command, const ErrorReport& report) {
  try {
    return command();
  } catch (const InputError& error) {
    return report(error.what(), exit_bad_input);
  } catch (const DivergenceError& error) {
    return report(error.what(), exit_diverged);
  } catch (const OutputError& error) {
    return report(error.what(), exit_not_written);
  } catch (const std::system_error& error) {  // what print_text throws
    return report(error.what(), exit_not_written);
  } catch (const ResourceError& error) {
    return report(error.what(), exit_internal_fault);
  } catch (const std::bad_alloc&) {  // of a size that no machine has
    return report("out of memory", exit_internal_fault);
  } catch (const std::exception& error) {
    return report(std::string("internal fault: ") + error.what(), exit_internal_fault);
  }
}

// `status`, of a command that has printed what it had to say, unless that went nowhere: an answer that nobody got is
// none.
int status_of_output(int status, const ErrorReport& report) {
  const bool printed = std::fflush(stdout) == 0 && !std::ferror(stdout);
  const bool answered = status == exit_done || status == exit_images_differ;
  return printed || !answered ? status : report("the output could not be written", exit_not_written);
}

}  // namespace

int run(int argc, char** argv, std::string_view commit) {
  open_standard_streams();
  ignore_write_signals();
  tidy_up_on_signals();
  heed_children();
  choose_remarks(Remarks::lines);
  CLI::App app("Filtered mass-spring cloth and fish, rendered offscreen", "billow");
  Request request;
  request.commit = commit;
  add_commands(app, request);
  const ErrorReport report(argc, argv);
  if (const auto fault = unknown_command(app, argc, argv)) return report(*fault, exit_usage);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    return report(unexpected_arguments(app), exit_usage);
  } catch (const CLI::ParseError& error) {
    std::ostringstream help, fault;
    const bool asked_for_help = app.exit(error, help, fault) == static_cast<int>(CLI::ExitCodes::Success);
    if (!asked_for_help) return report.usage(error, fault.str());
    return status_of_output(run_command([&] { return print_text(help.str()), exit_done; }, report), report);
  }
  request.render.command = typed_command(argc, argv);
  const int status = run_command(request.command, report);
  if (status > 128 && interrupted_by() != 0)
    return report(fmt::format("stopped by SIG{}", sigabbrev_np(interrupted_by())), status);
  return status_of_output(status, report);
}

}  // namespace billow::cli
