// How billow doctor says one thing.
#pragma once

#include <string_view>

#include "cli/text/terminal.h"

namespace billow::cli {

/// Prints "Eigen         3.4.0".
inline void doctor_line(std::string_view what, std::string_view found) { print_line("{:<13} {}", what, found); }

}  // namespace billow::cli
