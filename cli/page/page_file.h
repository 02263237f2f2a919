// The files of cli/page, built into the tool.
#pragma once

#include <string_view>

namespace billow::cli {

/// The text of cli/page/NAME. Throws std::logic_error when there is no such file.
std::string_view page_file(std::string_view name);

}  // namespace billow::cli
