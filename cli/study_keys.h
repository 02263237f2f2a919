// Every key that a study may have.
#pragma once

#include "cli/yaml_reader.h"

namespace billow::cli::keys {

extern const Section study, axis, axis_value, measure, picture_strips, picture_spectra, picture_frames, picture_plot,
    picture_spectrum_curves;

/// The sections of the kinds of pictures, in the order of PictureKind.
const Section& picture(int kind);
/// The words for them.
const std::vector<std::string_view>& picture_kinds();

}  // namespace billow::cli::keys
