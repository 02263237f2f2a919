// CLI11's objects -> what they say.
#include "cli/command/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <set>
#include <stdexcept>

#include "cli/run/progress.h"
#include "cli/scene/cache_format.h"
#include "render/gl/backend.h"
#include "render/image/compare.h"
#include "render/image/views.h"

namespace billow::cli {

namespace {

using Of = ArgumentKind::Of;

struct PlaceholderRow {
  std::string_view placeholder;  // after its command and a space where it means something else there
  ArgumentKind kind;
};

const std::vector<PlaceholderRow>& placeholders() {
  static const std::vector<PlaceholderRow> rows = {
      {"SCENE", {Of::file, {".yaml", ".yml"}}},
      {"STUDY", {Of::file, {".yaml", ".yml"}}},
      {"TESTS", {Of::file, {".yaml", ".yml"}}},
      {"mesh FILE", {Of::file, {".obj", ".off", ".stl", ".ply", ".gltf", ".glb"}}},
      {"FILE", {Of::file}},
      {"FILE|DIR", {Of::file}},
      {"A", {Of::file}},
      {"B", {Of::file}},
      {"DIR", {Of::folder}},
      {"BACKEND", {Of::word, all_words<render::BackendKind>()}},
      {"STYLE", {Of::word, all_words<ProgressStyle>()}},
      {"FORMATS", {Of::words, all_words<CacheFormat>()}},
      {"VIEWS", {Of::words, render::png_views()}},
      {"METRIC=LIMIT", {Of::assignment, all_words<render::Metric>()}},
      {"KEY.PATH=VALUE", {Of::text}},
      {"LIST", {Of::text}},
      {"NAME", {Of::text}},
      {"NAME...", {Of::text}},
      {"OPTIONS", {Of::text}},
      {"N", {Of::text}},
      {"N|N%", {Of::text}},
      {"SECONDS", {Of::text}},
  };
  return rows;
}

const ArgumentKind& kind_of(const std::string& command, const std::string& placeholder) {
  const std::string special = command + " " + placeholder;
  for (const std::string_view wanted : {std::string_view(special), std::string_view(placeholder)})
    for (const PlaceholderRow& row : placeholders())
      if (row.placeholder == wanted) return row.kind;
  throw std::logic_error(fmt::format(
      "the table in cli/command/command_line.cpp does not say what can stand for {} of '{}'", placeholder, command));
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

// "N" and " in [1 - 256]" of "N:INT in [1 - 256]": the checks of an option follow its type's name.
std::string placeholder_of(const CLI::Option& option) {
  if (!takes_value(option)) return {};
  if (option.get_positional()) return option.get_single_name();
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

void set_bounds(ArgumentEntry& argument, const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t in = type.find(" in ["), to = type.find(" - ", in), end = type.find(']', to);
  if (end == std::string::npos) return;
  argument.least = type.substr(in + 5, to - in - 5);
  argument.most = type.substr(to + 3, end - to - 3);
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

// In the order of the table, which the sets of CLI11 have not.
std::vector<std::string> names_of(const CLI::App& command, const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* other : command.get_options())
    if (options.count(const_cast<CLI::Option*>(other)) > 0) names.push_back(names_of(*other).back());
  return names;
}

ArgumentEntry describe(const CLI::App& command, const CLI::Option& option) {
  ArgumentEntry argument{.names = names_of(option),
                         .placeholder = placeholder_of(option),
                         .least = {},
                         .most = {},
                         .description = option.get_description(),
                         .required = option.get_required(),
                         .repeatable = takes_value(option) && option.get_expected_max() > 1,
                         .excludes = names_of(command, option.get_excludes()),
                         .needs = names_of(command, option.get_needs()),
                         .kind = {}};
  set_bounds(argument, option);
  if (argument.takes_value()) argument.kind = kind_of(command.get_name(), argument.placeholder);
  return argument;
}

CommandEntry describe(const CLI::App& app) {
  CommandEntry command{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty())
      (option->get_positional() ? command.positionals : command.options).push_back(describe(app, *option));
  return command;
}

}  // namespace

CommandLine describe_command_line(const CLI::App& program) {
  CommandLine line{describe(program), {}};
  for (const CLI::App* command : program.get_subcommands({}))
    if (!command->get_group().empty()) line.commands.push_back(describe(*command));
  return line;
}

}  // namespace billow::cli
