// Curves of a study's runs.
#pragma once

#include "cli/study/study_pictures.h"
#include "render/paper/plot.h"

namespace billow::cli {

/// The plot of a picture that is one. Runs that have no result, or diverged, leave a gap in their curve, and the plot's
/// note names them. Throws InputError where something of a finished run is missing or damaged.
render::Plot plot_of(const StudyContents& contents, const PictureSpec& picture);

}  // namespace billow::cli
