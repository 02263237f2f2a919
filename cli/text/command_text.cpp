// Words -> one line for a shell.
#include "cli/text/command_text.h"

namespace billow::cli {

namespace {

std::string shell_word(const std::string& word) {
  if (!word.empty() && word.find_first_of(" '\"\\$`*?[]{}()<>|&;#~!\n\t") == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

}  // namespace

std::string command_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

}  // namespace billow::cli
