// billow check: everything short of simulating; prints the effective scene.
#include <fmt/format.h>

#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/run/watched_scene.h"
#include "cli/scene/contact_text.h"
#include "cli/scene/filter_text.h"
#include "cli/scene/material_text.h"
#include "cli/scene/mesh_warnings.h"
#include "cli/scene/simulation.h"
#include "cli/scene/step_warnings.h"
#include "cli/text/terminal.h"

namespace billow::cli {

int check_command(const SceneOptions& options) {
  Progress progress(options.progress);
  const Scene scene = read_scene(options.scene, options.overrides, progress);
  progress.phase("springs");
  const Simulation simulation(scene);
  progress.phase("limit");
  const StepChoice choice = simulation.choose_step();
  progress.end();
  print_text(scene.effective);
  const sim::Structure& structure = simulation.structure();
  progress.say(
      fmt::format("{}: good. {} particles ({} pinned), {} springs, {} frames; k0 = {:.6g} /s², step {:.4g} s ({})",
                  scene.file.string(), structure.particles(), (structure.inverse_mass.array() == 0.0).count(),
                  structure.springs(), frame_count(scene), choice.k0.value, choice.step, choice.bound));
  for (const std::string& line : mesh_lines(scene)) progress.say(line);
  for (const std::string& line : material_lines(scene, structure)) progress.say(line);
  for (const std::string& line : level_lines(simulation)) progress.say(line);
  for (const std::string& line : contact_lines(scene)) progress.say(line);
  for (const std::string& warning : mesh_warnings(scene)) progress.say("warning: " + warning);
  for (const std::string& warning : step_warnings(structure, choice)) progress.say("warning: " + warning);
  return exit_done;
}

}  // namespace billow::cli
