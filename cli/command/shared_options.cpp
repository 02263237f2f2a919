// Options with their checks.
#include "cli/command/shared_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "base/file_trust.h"
#include "cli/cluster/spread.h"

namespace billow::cli {

Override parse_override(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw CLI::ValidationError("-D", fmt::format("'{}' is not key.path=value", text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::vector<FrameSpan> parse_frame_list(const std::string& text) {
  const auto spans = parse_frames(text);
  if (!spans)
    throw CLI::ValidationError("--frames", fmt::format("'{}' is no list of frames like 1-250,300-:5 or 7", text));
  return *spans;
}

std::vector<FrameSpan> parse_run_list(const std::string& text) {
  const auto spans = parse_frames(text);
  if (!spans) throw CLI::ValidationError("--runs", fmt::format("'{}' is no list of runs like 1-12,40- or 7", text));
  return *spans;
}

render::MetricLimit parse_metric(const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string name = text.substr(0, equals);
  for (const auto& [word, metric] : render::words(render::Metric())) {
    if (word != name) continue;
    double limit = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(std::min(text.data() + equals + 1, end), end, limit);
    const double most = render::largest(metric);
    if (error == std::errc() && rest == end && limit >= 0.0 && limit <= most) return {metric, limit};
    throw CLI::ValidationError("--metric",
                               fmt::format("'{}' has no limit from 0 to {:g}, like {}=0.1", text, most, name));
  }
  throw CLI::ValidationError("--metric", fmt::format("there is no metric '{}'{}", name,
                                                     suggestion(name, all_words<render::Metric>(), "metrics are")));
}

void add_named_file(CLI::App& command, const std::string& name, std::filesystem::path& file, const std::string& help,
                    Request& request) {
  command.add_option(name, file, help)->required();
  command.add_flag("--untrusted", request.untrusted,
                   "Read no file outside of the folder of " + name + ", links followed");
}

void set_command(Request& r, const std::filesystem::path& named, std::function<int()> command) {
  r.command = [&r, &named, command = std::move(command)] {
    trust_folder_of(named, r.untrusted ? Outside::refused : Outside::readable);
    return command();
  };
}

void require_scene_file(const std::filesystem::path& scene) {
  if (scene == "-")
    throw CLI::ValidationError(
        "SCENE",
        "a run needs a file to be repeated from, and '-' is standard input; save the scene as a file "
        "('check', 'structure' and 'stability' take '-')");
}

void add_scene_options(CLI::App& command, std::filesystem::path& scene, Request& request, const std::string& help) {
  add_named_file(command, "SCENE", scene, help, request);
  command.add_option("-D", request.overrides, "Set a scene value: -D solver.step=0.001 (repeatable)")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
}

std::string refuse_standard_output(const std::string& file) {
  return file == "-" ? "'-' is standard output, where this is not written; give it a name" : "";
}

void add_progress(CLI::App& command, ProgressStyle* style) {
  command
      .add_option_function<std::string>(
          "--progress",
          [style](const std::string& text) {
            const auto chosen = parse_word<ProgressStyle>("--progress", text);
            choose_remarks(remarks_of(chosen));
            if (style) *style = chosen;
          },
          "auto, plain, json or none, which leaves errors alone (default: auto)")
      ->type_name("STYLE");
}

void add_backend(CLI::App& command, Request& request) {
  command
      .add_option("--backend", request.backend,
                  "What draws: auto, osmesa, egl, or egl:N for the device of that number in 'billow doctor' (default: "
                  "BILLOW_BACKEND, or auto, which is always software, so that bytes repeat)")
      ->type_name("BACKEND");
}

render::Backend chosen_backend(const CLI::App& command, const Request& request) {
  const bool named = command.count("--backend") > 0;
  try {
    return named ? render::parse_backend(request.backend) : render::backend_of_environment();
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(named ? fmt::format("--backend: {}", error.what()) : std::string(error.what()));
  }
}

std::string backend_handed_on(const CLI::App& command, const render::Backend& backend) {
  const bool named = command.count("--backend") > 0 || backend.kind != render::BackendKind::automatic;
  return named ? text_of(backend) : "";
}

bool is_given(const CLI::App& command, const std::string& option) {
  const CLI::Option* const known = command.get_option_no_throw(option);
  return known && known->count() > 0;
}

std::vector<CLI::Option*> add_spread_options(CLI::App& c, Request& r, const std::string& piece,
                                             const std::string& usual_chunk) {
  CLI::Option* commands =
      c.add_flag("--commands", r.spread.commands, "Print lines of the shell that do the unfinished " + piece);
  CLI::Option* slurm = c.add_flag("--slurm", r.spread.slurm, "Print a script that has Slurm do what is unfinished");
  slurm->excludes(commands);
  c.add_flag("--submit", r.spread.submit, "Run that script")->needs(slurm);
  c.add_option("--array-limit", r.spread.array_limit, "Tasks that Slurm runs at a time (default: 16)")
      ->check(CLI::Range(1, 100000))
      ->type_name("N")
      ->needs(slurm);
  c.add_option("--sbatch", r.spread.sbatch, "More options for every job, as sbatch takes them (repeatable)")
      ->type_name("OPTIONS")
      ->allow_extra_args(false)
      ->needs(slurm)
      ->check([](const std::string& line) {
        const auto fault = sbatch_fault(line);
        return fault.value_or("");
      });
  c.add_option("--chunk", r.spread.chunk, "So many " + piece + " a line or task (default: " + usual_chunk + ")")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N");
  return {commands, slurm};
}

void check_spread(const Request& r) {
  if (r.spread.chunk > 0 && !r.spread.any()) throw CLI::ValidationError("--chunk", "needs --slurm or --commands");
}

}  // namespace billow::cli
