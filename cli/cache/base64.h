// Bytes as text.
#pragma once

#include <string>
#include <string_view>

namespace billow::cli {

/// RFC 4648, padded, on one line.
std::string base64(std::string_view bytes);

}  // namespace billow::cli
