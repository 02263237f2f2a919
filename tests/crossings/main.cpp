// crossings SCENE [-D KEY=VALUE]... [--threads N]: runs a scene and counts, with exact predicates, what of its surfaces
// crosses in every frame. Prints the frames that have crossings, a sum, and a hash of the last state; fails on any.
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "cli/scene/hash.h"
#include "cli/scene/simulation.h"
#include "tests/support/surface_crossings.h"

namespace billow {
namespace {

int run(const std::string& file, const std::vector<cli::Override>& overrides) {
  const cli::Scene scene = cli::read_scene(file, overrides);
  const cli::Simulation simulation(scene);
  const auto& contact = simulation.phase().contact;
  if (!contact) {
    fmt::print("{}: nothing touches\n", file);
    return 1;
  }
  long frame = 0, crossings = 0;
  const auto next = [&] {
    const double time = static_cast<double>(++frame) / scene.render.fps;
    return time <= scene.duration + 1e-9 ? time : INFINITY;
  };
  const auto watched = simulation.make_run(simulation.choose_step(), next);
  sim::State last = simulation.initial_state();
  long frames = 0;
  while (const auto sample = watched->next()) {
    last = sample->state;
    ++frames;
    const auto count = static_cast<long>(test::crossings_of(*contact, last));
    if (count > 0) fmt::print("t = {:.3f} s: {} crossings\n", last.time, count);
    crossings += count;
  }
  cli::Hash hash;
  hash.add({reinterpret_cast<const char*>(last.position.data()),
            sizeof(double) * static_cast<std::size_t>(last.position.size())});
  fmt::print("{}: {} crossings in {} frames, {} steps, {} incidents, last state {}\n", file, crossings, frames,
             watched->steps(), watched->incidents().size(), hash.hex());
  return crossings > 0;
}

}  // namespace
}  // namespace billow

int main(int argc, char** argv) {
  std::string scene;
  std::vector<billow::cli::Override> overrides;
  std::size_t threads = 2;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--threads" && k + 1 < argc) {
      threads = std::strtoul(argv[++k], nullptr, 10);
    } else if (word == "-D" && k + 1 < argc) {
      const std::string text = argv[++k];
      const auto equals = text.find('=');
      overrides.push_back({.path = text.substr(0, equals), .value = text.substr(equals + 1)});
    } else {
      scene = word;
    }
  }
  try {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    return billow::run(scene, overrides);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
