// What a run's end gives reason to warn of.
#pragma once

#include <string>
#include <vector>

#include "cli/run/film.h"

namespace billow::cli {

/// A sentence each: what was mended, what was stretched, what a filter took, what was not solved.
std::vector<std::string> run_warnings(const Run& run, const FilmReport& report);

}  // namespace billow::cli
