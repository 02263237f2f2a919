// Loads a scene, steps it and draws its last frame as the tool does, by the installed headers alone.
//
//   consumer SCENE PICTURE.png [KEY.PATH=VALUE...]
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <vector>

#include "cli/drawn/drawn_scene.h"
#include "cli/scene/scene.h"
#include "cli/scene/simulation.h"
#include "cli/text/version.h"
#include "render/frame/mesh_renderer.h"
#include "render/image/picture.h"

namespace {

using namespace billow;

std::vector<cli::Override> overrides_of(int argc, char** argv) {
  std::vector<cli::Override> overrides;
  for (int a = 3; a < argc; ++a) {
    const std::string text = argv[a];
    const std::size_t equals = text.find('=');
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

// The states of all frames.
std::vector<sim::State> states_of(const cli::Scene& scene, const cli::Simulation& simulation) {
  long frame = 0;
  const auto next_time = [&] {
    const double time = static_cast<double>(frame++) / scene.render.fps;
    return time < scene.duration ? time : std::numeric_limits<double>::infinity();
  };
  const auto run = simulation.make_run(simulation.choose_step(), next_time);
  std::vector<sim::State> states;
  while (const auto sample = run->next()) states.push_back(sample->state);
  return states;
}

void draw_last(const std::vector<sim::State>& states, const cli::DrawnScene& drawn, const char* file) {
  render::RunBounds bounds;
  for (const sim::State& state : states) bounds.box.extend(drawn.box(state));
  bounds.box.translate(-drawn.origin());
  render::MeshRenderer renderer(drawn.settings(), drawn.bodies(), bounds);
  const sim::State& last = states.back();
  render::write_picture(
      file, renderer.draw(render::View::textured, drawn.surfaces(last), drawn.camera_velocity(last), last.time));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  try {
    const cli::Scene scene = cli::read_scene(argv[1], overrides_of(argc, argv));
    const cli::Simulation simulation(scene);
    const std::vector<sim::State> states = states_of(scene, simulation);
    draw_last(states, cli::DrawnScene(scene, simulation), argv[2]);
    std::printf("billow %s: %zu states of %d particles\n", std::string(cli::version()).c_str(), states.size(),
                simulation.structure().particles());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
