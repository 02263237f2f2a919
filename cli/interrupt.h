// SIGINT and SIGTERM as a request to finish.
#pragma once

namespace billow::cli {

/// From here on the first SIGINT or SIGTERM is remembered instead of ending the process; the second one ends it.
void catch_interrupts();

/// The signal that asked for the end, or 0.
int interrupted_by();

}  // namespace billow::cli
