// billow render: a scene's frames, strip, record and page.
#include "base/atomic_file.h"
#include "base/process_start.h"
#include "cli/command/commands.h"
#include "cli/run/state_store.h"
#include "cli/run/watched_scene.h"

namespace billow::cli {

int render_command(const RenderOptions& options) {
  Progress progress(options.progress, process_start());
  if (options.durable) write_durably();
  const Scene scene = read_scene(options.scene, options.overrides, progress);
  // What is wrong with these is found before the step is certified, which takes seconds.
  range_of(options, scene);
  if (!options.from.empty()) check_stored_states(options.from);
  check_output_folder(output_of(options), existing_of(options), scene);
  check_backend(options);
  progress.phase("springs");
  const Simulation simulation(scene);
  progress.phase("limit");
  return render_scene(scene, simulation, simulation.choose_step(), options, progress);
}

}  // namespace billow::cli
