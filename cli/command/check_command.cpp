// billow check: everything short of simulating; prints the effective scene.
#include <fmt/format.h>

#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/run/watched_scene.h"
#include "cli/scene/simulation.h"

namespace billow::cli {

int check_command(const SceneOptions& options) {
  Progress progress(ProgressStyle::automatic);
  const Scene scene = read_scene(options.scene, options.overrides, progress);
  progress.phase("springs");
  const Simulation simulation(scene);
  progress.phase("limit");
  const StepChoice choice = simulation.choose_step();
  progress.end();
  fmt::print("{}", scene.effective);
  const sim::Structure& structure = simulation.structure();
  fmt::print(stderr, "{}: good. {} particles ({} pinned), {} springs, {} frames; k0 = {:.6g} /s², step {:.4g} s ({})\n",
             scene.file.string(), structure.particles(), (structure.inverse_mass.array() == 0.0).count(),
             structure.springs(), frame_count(scene), choice.k0.value, choice.step, choice.bound);
  if (choice.limit && choice.step > *choice.limit)
    fmt::print(stderr, "warning: the step is {:.4g} s, above the certified limit of {:.4g} s; the run may diverge\n",
               choice.step, *choice.limit);
  for (const std::string& law : choice.unbounded)
    fmt::print(stderr, "warning: the step limit does not count {}, which has no bound; the run may diverge\n", law);
  return exit_done;
}

}  // namespace billow::cli
