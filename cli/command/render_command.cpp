// billow render: a scene's frames, strip, record and page.
#include "cli/command/commands.h"

namespace billow::cli {

int render_command(const RenderOptions& options) {
  const Scene scene = read_scene(options.scene, options.overrides);
  // What is wrong with these is found before the step is certified, which takes seconds.
  range_of(options, scene);
  check_output_folder(output_of(options), options.existing, scene.hash);
  const Simulation simulation(scene);
  return render_scene(scene, simulation, simulation.choose_step(), options);
}

}  // namespace billow::cli
