// Scripts by which shells complete the tool's commands, options and values.
#pragma once

#include <string>

#include "cli/command/command_line.h"

namespace billow::cli {

/// For /usr/share/bash-completion/completions; bash 4.4 or later, with or without the package bash-completion.
std::string bash_completion(const CommandLine& line);
/// For a folder of zsh's fpath, as _billow.
std::string zsh_completion(const CommandLine& line);
/// For a vendor_completions.d of fish, 3.4 or later.
std::string fish_completion(const CommandLine& line);

}  // namespace billow::cli
