// Every key that a study may have.
#pragma once

#include "cli/scene/scene_keys.h"
#include "cli/study/study.h"
#include "cli/yaml/yaml_reader.h"

namespace billow::cli::keys {

extern const Section study, axis, axis_value, measure, error, picture_strips, picture_spectra, picture_frames,
    picture_plot, picture_spectrum_curves;

/// All sections but those of pictures, and where each stands in a study: what a study's schema must say as well.
const std::vector<PlacedSection>& sections_of_a_study();

/// The section of a kind of picture.
const Section& picture(PictureKind kind);

}  // namespace billow::cli::keys
