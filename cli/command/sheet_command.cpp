// billow sheet: frames of a run side by side on one page, with their times.
#include "base/readable_number.h"
#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/run/contact_sheet.h"
#include "cli/text/terminal.h"
#include "render/image/png.h"

namespace billow::cli {

int sheet_command(const SheetOptions& options) {
  const FinishedRun run = read_finished_run(options.folder);
  const std::vector<render::View> views = chosen_views(run, options.views);
  const std::filesystem::path file =
      options.output.empty() ? run.folder / (joined_names(views) + "_sheet.png") : options.output;
  check_replaceable(file, options.overwrite);
  const TimedFrames chosen = evenly_chosen(run.frames, static_cast<std::size_t>(options.count));
  render::write_png(file, contact_sheet(run, views, chosen, static_cast<std::size_t>(options.columns)));
  say_line("wrote {} ({})", file.string(), counted(static_cast<long>(chosen.size()), "frame"));
  return exit_done;
}

}  // namespace billow::cli
