// stdin, stdout and stderr of whoever started the process.
#pragma once

namespace billow {

/// Opens those that were closed, on /dev/null: else the next file or pipe would get their number, and what is printed
/// or silenced would go into it. What is written to a stdout that was closed still fails, as an answer that is lost
/// must; messages to such a stderr do not. Call it first.
void open_standard_streams();

}  // namespace billow
