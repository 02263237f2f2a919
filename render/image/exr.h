// OpenEXR files out, and whether they are whole. exr.cpp and exr_rows.cpp alone know OpenEXR.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "render/image/image.h"

namespace billow::render {

/// Writes all channels as 32-bit floats, the notes as attributes of the header, ZIP-compressed; whole or not at all.
/// The same values give the same bytes. Throws OutputError.
void write_exr(const std::filesystem::path& file, const DataImage& image);

/// What is wrong with a file that write_exr should have written of an image of this size [pixel], as the end of a
/// sentence about it. Nothing where its rows are all there: every block is unpacked for its checksum, on all threads.
/// A block that did not get smaller by packing has no checksum: a wrong number in it stays unnoticed.
std::optional<std::string> exr_fault(const std::filesystem::path& file, int width, int height);

}  // namespace billow::render
