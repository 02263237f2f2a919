// Every command with its options.
#pragma once

#include "cli/command/shared_options.h"

namespace billow::cli {

/// Adds all commands; what they are given is in `r` once the arguments have been read. Both must outlive that.
void add_commands(CLI::App& app, Request& r);

}  // namespace billow::cli
