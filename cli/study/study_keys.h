// Every key that a study may have.
#pragma once

#include "cli/study/study.h"
#include "cli/yaml/yaml_reader.h"

namespace billow::cli::keys {

extern const Section study, axis, axis_value, measure, error, picture_strips, picture_spectra, picture_frames,
    picture_plot, picture_spectrum_curves;

/// The section of a kind of picture.
const Section& picture(PictureKind kind);

}  // namespace billow::cli::keys
