// Options that several commands have, and what they fill.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/suggest.h"
#include "base/words.h"
#include "cli/command/commands.h"
#include "render/gl/backend.h"

namespace billow::cli {

/// What the arguments ask for: filled by CLI11, run afterwards.
struct Request {
  RenderOptions render;
  SceneOptions scene;
  MeshOptions mesh;
  StabilityOptions stability;
  FilterCommandOptions filter;
  CompareOptions compare;
  GoldenOptions golden;
  StudyOptions study;
  VideoOptions video;
  SheetOptions sheet;
  SpreadOptions spread;
  Generated generated = Generated::man;
  std::vector<std::string> overrides, metrics;
  std::string frames, runs, caches, pixels, channel, worst, backend;
  bool overwrite = false, resume = false, untrusted = false, version_as_json = false;
  std::string_view commit;
  std::function<int()> command;
};

/// "key.path=value", "1-250,300-:5", "1-12,40-" and "ssim=0.99". All functions here throw CLI::ValidationError.
Override parse_override(const std::string& text);
std::vector<FrameSpan> parse_frame_list(const std::string& text);
std::vector<FrameSpan> parse_run_list(const std::string& text);
render::MetricLimit parse_metric(const std::string& text);

/// The file that the command is about, and how far what it names is trusted.
void add_named_file(CLI::App& command, const std::string& name, std::filesystem::path& file, const std::string& help,
                    Request& request);

/// What is run once all arguments are read.
void set_command(Request& r, const std::filesystem::path& named, std::function<int()> command);

/// A run's record names its scene, and its output folder is named after it: no standard input.
void require_scene_file(const std::filesystem::path& scene);

void add_scene_options(CLI::App& command, std::filesystem::path& scene, Request& request,
                       const std::string& help = "Scene file (YAML), or - for standard input");

/// The value that one of an enumeration's words stands for.
template <class Enum>
Enum parse_word(const std::string& option, const std::string& text) {
  for (const auto& [word, value] : words(Enum()))
    if (word == text) return value;
  throw CLI::ValidationError(option,
                             fmt::format("there is no '{}'{}", text, suggestion(text, all_words<Enum>(), "it takes")));
}

/// For options of files and folders that are written: "-" would become one of that name. Returns what is wrong.
std::string refuse_standard_output(const std::string& file);

/// Also of what is said besides; `style` is for a command whose Progress wants to know.
void add_progress(CLI::App& command, ProgressStyle* style = nullptr);

void add_backend(CLI::App& command, Request& request);
/// Of the option or of the environment: what is wrong with either is found before anything runs.
render::Backend chosen_backend(const CLI::App& command, const Request& request);
/// What other processes, which have an environment of their own, are told; empty where nobody named one.
std::string backend_handed_on(const CLI::App& command, const render::Backend& backend);

/// Also with an empty value, which a variable of a script may have.
bool is_given(const CLI::App& command, const std::string& option);

/// How work is handed to others: the options that stand in place of doing it, which are returned.
std::vector<CLI::Option*> add_spread_options(CLI::App& c, Request& r, const std::string& piece,
                                             const std::string& usual_chunk);
/// Those of them that depend on either of two.
void check_spread(const Request& r);

}  // namespace billow::cli
