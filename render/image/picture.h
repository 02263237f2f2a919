// What a view's frame can be, and writing it as the file that goes with it.
#pragma once

#include <filesystem>
#include <variant>

#include "render/image/image.h"

namespace billow::render {

using Picture = std::variant<Image, Image16, DataImage>;

/// Images as PNG, data as OpenEXR; whole or not at all. The same pixels give the same bytes. Throws OutputError.
void write_picture(const std::filesystem::path& file, const Picture& picture);

}  // namespace billow::render
