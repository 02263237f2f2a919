// What a surface is drawn with.
#pragma once

#include <Eigen/Core>

#include "base/alpha_mode.h"
#include "render/image/image.h"

namespace billow::render {

/// A texture times a colour.
struct Finish {
  Image texture = {};                                 // empty: white
  Eigen::Vector3f colour{0.4564f, 0.4564f, 0.4564f};  // linear-light RGB in [0, 1]
  float opacity = 1.0f;                               // in [0, 1], times the texture's alpha
  AlphaMode alpha = AlphaMode::opaque;
  float cutoff = 0.5f;  // of cut_out

  /// The alpha below which nothing is there: what casts no shadow and has no velocity.
  float hole_below() const {
    return alpha == AlphaMode::cut_out ? cutoff : alpha == AlphaMode::blend ? 1.0f / 512 : 0.0f;
  }
};

}  // namespace billow::render
