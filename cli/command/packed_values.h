// Values that a browser cannot decode itself, as pictures that it can.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/command/compared_images.h"

namespace billow::cli {

/// Of a pair of OpenEXR or 16-bit PNG images, what compare.js shows of their values: "white", which is 1 or 65535,
/// "layers" with a name and the channels of each, those of them that are "identities" and of these the "hashes",
/// "layer", the one that is shown first, and under "a" and "b" width, height and "data", null where there is no such
/// file. The data is a PNG image of the 32-bit floats' bytes: byte k (the lowest is 0) of channel c, of the layers'
/// channels one after the other, is the plane p = 4 c + k, which is component p mod 3 of the rows from p / 3 times the
/// height on. Null for a pair of 8-bit images. Layers without differences are left out, but for the colours, and so is
/// what would take more than 32 MiB of an image unpacked.
nlohmann::ordered_json packed_values(const ComparedPair& pair);

}  // namespace billow::cli
