// What a view's frame can be, and writing it as the file that goes with it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "render/image/image.h"

namespace billow::render {

using Picture = std::variant<Image, Image16, DataImage>;

/// Images as PNG, data as OpenEXR; whole or not at all. The same pixels give the same bytes. Throws OutputError.
void write_picture(const std::filesystem::path& file, const Picture& picture);

/// What is wrong with a file that write_picture should have written of a picture of this size [pixel], as the end of a
/// sentence about it (png_fault, exr_fault). Nothing where it is whole.
std::optional<std::string> picture_fault(const std::filesystem::path& file, int width, int height);

}  // namespace billow::render
