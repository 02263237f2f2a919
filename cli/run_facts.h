// What a run's page says in words: collected from the run.
#pragma once

#include <string>
#include <vector>

#include "cli/film.h"
#include "cli/run_page.h"
#include "cli/scene.h"
#include "cli/simulation.h"

namespace billow::cli {

/// Everything that run_page_html needs. `warnings` are those that the run printed, without "warning: ".
RunPage describe_run(const Scene& scene, const std::string& command, const Simulation& simulation,
                     const StepChoice& choice, const Survey& survey, const FilmReport& report,
                     const std::vector<std::string>& warnings);

}  // namespace billow::cli
