// What a run's page says in words: collected from the run.
#pragma once

#include <string>
#include <vector>

#include "cli/run/film.h"
#include "cli/run/run_page.h"
#include "cli/scene/scene.h"
#include "cli/scene/simulation.h"

namespace billow::cli {

/// The wall clock's time until now, and the phases that it is made of.
std::string time_taken(const Progress& progress, const FilmReport& report);

/// Everything that run_page_html needs. `warnings` are those that the run printed, without "warning: ".
RunPage describe_run(const Run& run, const FilmReport& report, const std::vector<std::string>& warnings,
                     const Progress& progress);

}  // namespace billow::cli
