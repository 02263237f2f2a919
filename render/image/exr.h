// OpenEXR files out. exr.cpp is the only file that knows OpenEXR.
#pragma once

#include <filesystem>

#include "render/image/image.h"

namespace billow::render {

/// Writes all channels as 32-bit floats, the notes as attributes of the header, ZIP-compressed; whole or not at all.
/// The same values give the same bytes. Throws OutputError.
void write_exr(const std::filesystem::path& file, const DataImage& image);

}  // namespace billow::render
