// billow render: a scene's frames, strip, record and page.
#include "base/atomic_file.h"
#include "base/process_start.h"
#include "cli/command/commands.h"
#include "cli/run/state_store.h"
#include "cli/run/watched_scene.h"
#include "cli/text/command_text.h"

namespace billow::cli {

namespace {

// What is collected says how the same is made by one process, as a record that one has written does.
std::string command_of_whole(const RenderOptions& options) {
  std::vector<std::string> words = {"billow", "render", options.scene.string()};
  add_overrides(options.overrides, words);
  if (options.backend.kind != render::BackendKind::automatic)
    words.insert(words.end(), {"--backend", text_of(options.backend)});
  RenderOptions whole = options;
  whole.output.clear(), whole.from.clear();
  if (const auto folder = output_of(options); folder != output_of(whole))
    words.insert(words.end(), {"-o", folder.string()});
  return command_line(words);
}

}  // namespace

int render_command(const RenderOptions& given) {
  RenderOptions options = given;
  if (options.collect) options.command = command_of_whole(options);
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
