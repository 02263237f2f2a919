// Where a process's number means something.
#pragma once

#include <string>
#include <string_view>

namespace billow {

/// At most 255 bytes of `text`, with ? for what is no printable ASCII.
std::string plain_ascii(std::string_view text);

/// This machine's name, in printable ASCII; "?" where it has none.
std::string host_name();

/// The same text for two processes exactly when their numbers mean the same: those of one boot of one machine, in one
/// container on it. On one line, in printable ASCII.
std::string process_space();

}  // namespace billow
