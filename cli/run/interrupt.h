// SIGINT, SIGTERM and SIGHUP as a request to finish, and the end without delay; broken pipes and file-size limits as
// ordinary write errors; children that end.
#pragma once

namespace billow::cli {

/// From here on SIGINT, SIGTERM and SIGHUP remove what is half written before they end the process. Those that whoever
/// started it ignores stay ignored.
void tidy_up_on_signals();

/// From here on the first of these signals is remembered instead of ending the process; the second one ends it. Call it
/// when there is something to finish; before, the end at once is the cleanest.
void catch_interrupts();

/// A closed pipe or a file-size limit from here on is an error of the write that meets it, not the end of the process.
void ignore_write_signals();

/// From here on the ends of children can be waited for, also where this process was started with their signal ignored.
void heed_children();

/// The signal that asked for the end, or 0.
int interrupted_by();

}  // namespace billow::cli
