// billow filter: what each filter keeps and what it slows, the scene's own beside others.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/suggest.h"
#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/run/output_folder.h"
#include "cli/run/watched_scene.h"
#include "cli/scene/filter_text.h"
#include "cli/scene/simulation.h"
#include "cli/text/json_text.h"
#include "cli/text/terminal.h"
#include "render/paper/plot.h"
#include "sim/filter/response.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr int waves = 96;

struct Response {
  std::string name;
  std::vector<sim::WaveResponse> wave;
};

const sim::Body& chosen_body(const sim::Structure& structure, const std::string& name) {
  if (name.empty()) return structure.body.front();
  std::vector<std::string_view> names;
  for (const sim::Body& body : structure.body) {
    if (body.name == name) return body;
    names.push_back(body.name);
  }
  throw InputError(fmt::format("--body: there is no body '{}'{}", name, suggestion(name, names, "bodies are")));
}

/// The filters that every scene's own one is shown beside.
struct Known {
  std::string name;
  sim::FilterOptions options;
};

std::vector<Known> known_filters() {
  using sim::FilterKernel, sim::FilterForm, sim::FilterTarget;
  std::vector<Known> list;
  for (const FilterKernel kernel : {FilterKernel::exponential, FilterKernel::gaussian})
    list.push_back({fmt::format("{}, λ = 1", word_of(kernel)),
                    {.kernel = kernel, .form = FilterForm::conserving, .target = FilterTarget::force}});
  for (const double ratio : {3.0, 6.0, 10.0})
    list.push_back({fmt::format("levels ×{:g}", ratio),
                    {.kernel = FilterKernel::levels, .target = FilterTarget::force, .ratio = ratio}});
  return list;
}

void require_waves(const sim::Structure& structure, const sim::Body& body) {
  if (sim::free_mass(structure, body).sum() == 0.0)
    throw InputError(fmt::format(
        "every particle of '{}' is pinned, so that no wave runs in it; choose another with --body", body.name));
}

std::vector<Response> responses(const Scene& scene, const Simulation& simulation, const sim::Body& body) {
  const sim::Structure& structure = simulation.structure();
  std::vector<Response> list;
  if (simulation.filter_operator())
    list.push_back({"this scene: " + filter_text(scene, simulation),
                    sim::wave_responses(structure, body, simulation.filter_operator(), waves)});
  for (const Known& known : known_filters()) {
    try {
      const sim::Filter filter(structure, known.options);
      list.push_back({known.name, sim::wave_responses(structure, body, &filter, waves)});
    } catch (const InputError& error) {
      say_line("{}: {}", known.name, error.what());
    }
  }
  return list;
}

render::Plot plot_of(const std::vector<Response>& list, const sim::Body& body) {
  render::Plot plot{.title = fmt::format("What filters keep of {}", body.name),
                    .x_label = "undamped frequency of a wave [1/s]",
                    .y_label = "share of its force that passes",
                    .log_x = true,
                    .log_y = false,
                    .points = false,
                    .curves = {}};
  for (const Response& response : list) {
    render::Curve curve{response.name, {}, {}};
    for (const sim::WaveResponse& wave : response.wave)
      curve.x.push_back(wave.frequency), curve.y.push_back(wave.response);
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

Json as_json(const Simulation& simulation, const std::vector<Response>& list) {
  Json json = {{"levels", Json::array()}, {"responses", Json::array()}};
  if (simulation.filter_operator()) {
    const std::vector<sim::LevelTable> bodies = simulation.filter_operator()->levels();
    for (std::size_t b = 0; b < bodies.size(); ++b)
      json["levels"].push_back({{"body", simulation.structure().body[b].name},
                                {"nodes", bodies[b].nodes},
                                {"gamma", bodies[b].shares.gamma},
                                {"correction", bodies[b].shares.correction}});
  }
  for (const Response& response : list) {
    Json entry = {{"filter", response.name}, {"frequency", Json::array()}, {"response", Json::array()}};
    for (const sim::WaveResponse& wave : response.wave) {
      entry["frequency"].push_back(wave.frequency);
      entry["response"].push_back(wave.response);
    }
    json["responses"].push_back(std::move(entry));
  }
  return json;
}

// The wave in the middle of each sixth.
void print_table(const std::vector<Response>& list) {
  constexpr int columns = 6;
  const auto at = [](int column) { return static_cast<std::size_t>((2 * column + 1) * waves / (2 * columns)); };
  std::string head = fmt::format("{:<44}", "share of a wave's force that passes, at 1/s");
  for (int c = 0; c < columns; ++c) head += fmt::format("{:>9.3g}", list.front().wave.at(at(c)).frequency);
  print_line("{}", head);
  for (const Response& response : list) {
    // Widths are in characters, and some of ours take two bytes.
    const auto two_bytes = std::count_if(response.name.begin(), response.name.end(),
                                         [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; });
    std::string line = fmt::format("{:<{}}", response.name, 44 + two_bytes);
    for (int c = 0; c < columns; ++c) line += fmt::format("{:>9.3f}", response.wave.at(at(c)).response);
    print_line("{}", line);
  }
}

}  // namespace

int filter_command(const FilterCommandOptions& options) {
  Progress progress(options.scene.progress);
  const Scene scene = read_scene(options.scene.scene, options.scene.overrides, progress);
  progress.phase("springs");
  const Simulation simulation(scene);
  const sim::Body& body = chosen_body(simulation.structure(), options.body);
  require_waves(simulation.structure(), body);
  progress.phase("responses");
  const std::vector<Response> list = responses(scene, simulation, body);
  progress.end();
  if (options.scene.json) return print_json(json_text(as_json(simulation, list), 1)), exit_done;
  for (const std::string& line : level_lines(simulation)) print_line("{}", line);
  print_table(list);
  const std::filesystem::path folder =
      options.output.empty() ? std::filesystem::path("out") / (scene.file.stem().string() + "-filter") : options.output;
  make_folder(folder);
  render::write_plot(plot_of(list, body), folder / "response");
  print_line("wrote response.png, .svg and .csv to {}", folder.string());
  return exit_done;
}

}  // namespace billow::cli
