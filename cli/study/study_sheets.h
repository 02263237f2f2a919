// Strips, spectra and frames of a study's runs, side by side.
#pragma once

#include "cli/study/study_pictures.h"
#include "render/paper/sheet.h"

namespace billow::cli {

/// The sheet of a picture that is no plot, with the scales of the colours in it. Throws InputError where none of its
/// runs is finished, or where something of one that is finished is missing or damaged.
render::Sheet sheet_of(const StudyContents& contents, const PictureSpec& picture);

}  // namespace billow::cli
