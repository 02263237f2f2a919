// A line for stderr that is only said when something takes long.
#pragma once

#include <string>

namespace billow {

/// Writes `line` to stderr after `seconds` > 0 unless it is withdrawn before; replaces what was to be announced. By a
/// timer's signal (SIGALRM), not by a thread: meshes are read in a forked child, and there must be none then.
void announce_later(std::string line, double seconds);

/// Takes the line back, unless it has been written already.
void withdraw_announcement();

}  // namespace billow
