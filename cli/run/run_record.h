// run.json: what a run was, what it made, and what it cost.
#pragma once

#include <filesystem>
#include <string>

#include "cli/run/film.h"
#include "cli/scene/scene.h"
#include "cli/scene/simulation.h"

namespace billow::cli {

/// The record of a run that has only begun: enough for --resume to know it by.
std::string begun_record(const Scene& scene, const std::string& command);

/// Writes the record of a run that ended, whole, diverged or interrupted, to `file`: whole or not at all. Its times are
/// those of `progress` until now. Throws OutputError.
void write_finished_record(const std::filesystem::path& file, const Run& run, const Survey& survey,
                           const FilmReport& report, const Progress& progress);

}  // namespace billow::cli
