// Which billow this is.
#pragma once

#include <string_view>

namespace billow::cli {

/// "MAJOR.MINOR.PATCH"
std::string_view version();

}  // namespace billow::cli
