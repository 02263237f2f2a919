// The manual page, billow(1).
#pragma once

#include <string>

#include "cli/command/command_line.h"

namespace billow::cli {

/// In the language of man(7), in ASCII, as groff and mandoc read it.
std::string manual_page(const CommandLine& line);

}  // namespace billow::cli
