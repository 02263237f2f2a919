// An error's message for programs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace billow::cli {

/// The message as JSON on one line: "file", "line" and "column" where it says them, "message" and "hint" (what is wrong
/// and what to do, which "; " parts), and the exit status, "exit". What it does not say is null. A file without a place
/// is told by being one of the command's `arguments`, or there.
std::string error_json(std::string_view message, int status, const std::vector<std::string>& arguments);

}  // namespace billow::cli
