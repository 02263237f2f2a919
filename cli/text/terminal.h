// What the tool prints. Every command prints through here, so that nothing that a file, a name or an argument says
// reaches a terminal as anything but text.
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>

namespace billow::cli {

/// `text` with what is not printable written out, so that it is one line: control characters as \x1b, \n, \r and \t,
/// others that a terminal would act on or not show (C1 controls, directions of writing, marks without a width, private
/// ones) as \u202e or \U000e0001, bytes that are no UTF-8 as \x9b. Letters of any script stay. A quoted text in YAML
/// reads back from it.
std::string printable(std::string_view text);

/// The same of several lines: their ends stay.
std::string printable_lines(std::string_view text);

/// The same of JSON, with the escapes of its strings: the value stays.
std::string printable_json(std::string_view json);

/// To stdout: a command's answer, as one line, as lines of its own or as JSON, to which a line end is added. Throw
/// std::system_error when it cannot be written.
void print_text(std::string_view lines);
void print_json(std::string_view json);
template <class... Values>
void print_line(fmt::format_string<Values...> format, Values&&... values) {
  print_text(printable(fmt::format(format, std::forward<Values>(values)...)) + "\n");
}

/// How say_line says what it says, in the whole process: as lines, as objects {"message": …}, or not at all.
enum class Remarks { lines, json, none };
void choose_remarks(Remarks);
Remarks remarks();

/// To stderr: what is said besides. Never fails: a closed stderr must not become another error. Of a line of more than
/// 4000 bytes the middle is left out: files can have names and lists of any length.
void say_text(std::string_view lines);
void say_json(std::string_view json);
void say_message(std::string_view line);
void say_remark(const std::string& line);
template <class... Values>
void say_line(fmt::format_string<Values...> format, Values&&... values) {
  say_remark(fmt::format(format, std::forward<Values>(values)...));
}

/// Takes a terminal's line back, for another in its place.
inline constexpr std::string_view wipe = "\r\033[K";
void wipe_line();
/// The line, printable, in the place of the one that is there, and without an end.
void redraw_line(std::string_view line);

}  // namespace billow::cli
