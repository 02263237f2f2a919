// The header of an OpenEXR file, measured before OpenEXR makes room for what it claims.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace billow::render {

/// What is wrong with the file, as the end of a sentence about it: it is empty, no OpenEXR image, or its headers do not
/// add up. Nothing where every attribute of every part lies within the file and is as long as its type and what it
/// lists say: OpenEXR would make room for up to 2 GiB before it looks. Whether the values mean something is not asked.
/// Throws std::filesystem::filesystem_error when the file cannot be looked at.
std::optional<std::string> exr_header_fault(const std::filesystem::path& file);

}  // namespace billow::render
