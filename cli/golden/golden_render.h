// A test's scene -> the pictures that are compared.
#pragma once

#include <filesystem>

#include "cli/golden/golden_tests.h"
#include "render/gl/backend.h"

namespace billow::cli {

/// Renders into the folder `film`, and leaves in `pictures`, an empty folder, those that are compared, by the names
/// that they have in a run's folder. Returns 0, or 128 + a signal that ended it. Throws InputError, also where the
/// scene does not have what the test compares, DivergenceError, OutputError.
int render_pictures(const RenderedPictures& test, const std::filesystem::path& film,
                    const std::filesystem::path& pictures, const render::Backend& backend, int threads);

}  // namespace billow::cli
