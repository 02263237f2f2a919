// Textures: PNG and JPEG files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "render/image/image.h"

namespace billow::render {

/// Reads a PNG or a JPEG image, whichever its first bytes say, as 8-bit RGB or RGBA. Throws InputError on a file that
/// is missing, damaged, neither of the two, larger than 8192 x 8192 or than 256 MiB, and on a JPEG image of more than
/// 100 scans.
Image read_texture(const std::filesystem::path& file);

/// The same of the bytes of a file; `name` stands for it in messages.
Image decode_texture(std::string_view bytes, const std::string& name);

/// How many pixels the header of such bytes claims; 0 where they have none.
std::size_t claimed_pixels(std::string_view bytes);

/// Whether any pixel lets something behind it show.
bool has_alpha(const Image& image);

/// `image` with the mean of `grey`'s colours as its alpha (nearest pixel where the sizes differ).
Image with_alpha(const Image& image, const Image& grey);

/// Gives the pixels that nothing is seen of the colours of their nearest neighbours: filtering would mix into edges
/// whatever the file has there.
void bleed_into_holes(Image& image);

}  // namespace billow::render
