// What a run's page says in words: collected from the run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/sudden_end.h"
#include "cli/run/film.h"
#include "cli/run/frame_list.h"
#include "cli/run/run_page.h"
#include "cli/scene/scene.h"
#include "cli/scene/simulation.h"

namespace billow::cli {

/// The wall clock's time until now, and the phases that it is made of.
std::string time_taken(const Progress& progress, const FilmReport& report);

/// Which frames a run was to draw, and which a page can show.
struct FilmFrames {
  FrameRange asked;
  std::optional<std::vector<long>> there = {};  // those in the folder by now, where other runs have drawn some of them
  bool states_alone = false;                    // nothing was to be drawn
};

/// Everything that run_page_html needs, of a run that has come to its end, whole, diverged or interrupted. `warnings`
/// are those that the run printed, without "warning: ".
RunPage describe_run(const Run& run, const FilmReport& report, const FilmFrames& frames,
                     const std::vector<std::string>& warnings, const Progress& progress);

/// The same of one that ended before it could tell what it did: `frames.there` is all that is known. `reason` is what
/// was said on stderr; it may be empty.
RunPage describe_unfinished_run(const Run& run, SuddenEnd how, const std::string& reason, const FilmFrames& frames,
                                const std::vector<std::string>& warnings);

}  // namespace billow::cli
