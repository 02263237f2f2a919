// Runs the billow tool as a user would.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace billow::test {

struct ToolResult {
  int status = -1;  // exit status, or 128 + signal
  std::string output, errors;
};

/// Runs `program`, a path or a name on PATH, with `arguments` in `folder` and waits. With `interrupt_after` [s] >= 0
/// sends SIGINT then, or, with `interrupt_when`, so long after that file has appeared. Status 127: there is no such
/// program.
ToolResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                       const std::filesystem::path& folder, double interrupt_after = -1.0,
                       const std::filesystem::path& interrupt_when = {});

/// Runs the tool with `arguments` as run_program does.
ToolResult run_tool(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                    double interrupt_after = -1.0, const std::filesystem::path& interrupt_when = {});

std::string read_text(const std::filesystem::path& file);

}  // namespace billow::test
