// Identities as pixels: Cryptomatte 1.2.0 (Friedman & Jones, Psyop 2015).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/image/image.h"

namespace billow::render {

/// MurmurHash3 x86 32 (Appleby), seed 0.
std::uint32_t murmur3(std::string_view text);

/// The number that stands for `name`: the bits of its hash, one of them flipped where they would be a NaN, an infinity
/// or denormal.
float cryptomatte_id(std::string_view name);

/// The header's entries for the layer `layer` whose pixels hold these names: name, hash, conversion and manifest.
ImageNotes cryptomatte_notes(const std::string& layer, const std::vector<std::string>& names);

}  // namespace billow::render
