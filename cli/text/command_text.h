// Commands as a shell takes them.
#pragma once

#include <string>
#include <vector>

namespace billow::cli {

/// The words in one line, quoted where a shell would read them otherwise.
std::string command_line(const std::vector<std::string>& words);

}  // namespace billow::cli
