// How alpha is shown.
#pragma once

#include "base/words.h"

namespace billow {

/// How a surface shows an alpha below 1.
enum class AlphaMode {
  opaque,   ///< not at all
  cut_out,  ///< below the cutoff the surface is not there
  blend,    ///< what is behind shows through
};

inline Words<AlphaMode> words(AlphaMode) {
  static constexpr Word<AlphaMode> list[] = {
      {"opaque", AlphaMode::opaque}, {"cut_out", AlphaMode::cut_out}, {"blend", AlphaMode::blend}};
  return list;
}

}  // namespace billow
