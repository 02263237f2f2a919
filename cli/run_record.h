// run.json: what a run was, what it made, and what it cost.
#pragma once

#include <filesystem>
#include <string>

#include "cli/film.h"
#include "cli/scene.h"
#include "cli/simulation.h"

namespace billow::cli {

/// The record of a run that has only begun: enough for --resume to know it by.
std::string begun_record(const Scene& scene, const std::string& command);

/// Writes the record of a run that ended, whole, diverged or interrupted, to `file`: whole or not at all. Throws
/// OutputError.
void write_finished_record(const std::filesystem::path& file, const Scene& scene, const std::string& command,
                           const Simulation& simulation, const StepChoice& choice, const Survey& survey,
                           const FilmReport& report);

}  // namespace billow::cli
