// Whether a PNG file is whole, found out without decoding it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace billow::render {

/// What is wrong with a file that should hold a PNG image of this size [pixel], as the end of a sentence about it: that
/// it is empty, cut short, damaged, of another size. Nothing where its chunks are all there with the right checksums:
/// reads every byte once, and holds 64 KiB.
std::optional<std::string> png_fault(const std::filesystem::path& file, int width, int height);

}  // namespace billow::render
