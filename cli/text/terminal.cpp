// What is printable is told by code point, not by the locale: the tool runs in whatever locale there is.
#include "cli/text/terminal.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <iterator>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/utf8.h"
#include "cli/text/json_text.h"

namespace billow::cli {
namespace {

struct Span {
  char32_t first, last;
};

// In ascending order. Unicode's Cc, Zl and Zp; of its Cf what has no shape of its own; letters without a shape;
// private ones and those that are none, which a font may show as anything.
constexpr Span unprintable[] = {{0x00, 0x1F},     {0x7F, 0x9F},       {0xAD, 0xAD},       {0x34F, 0x34F},
                                {0x61C, 0x61C},   {0x115F, 0x1160},   {0x17B4, 0x17B5},   {0x180B, 0x180F},
                                {0x200B, 0x200F}, {0x2028, 0x202E},   {0x2060, 0x206F},   {0x3164, 0x3164},
                                {0xE000, 0xF8FF}, {0xFDD0, 0xFDEF},   {0xFEFF, 0xFEFF},   {0xFFA0, 0xFFA0},
                                {0xFFF0, 0xFFFB}, {0x1D173, 0x1D17A}, {0xE0000, 0x10FFFF}};

bool is_printable(char32_t code) {
  const auto* span = std::lower_bound(std::begin(unprintable), std::end(unprintable), code,
                                      [](const Span& s, char32_t c) { return s.last < c; });
  const bool in_span = span != std::end(unprintable) && code >= span->first;
  return !in_span && (code & 0xFFFE) != 0xFFFE;
}

/// How a character that is not printable is written; `bytes` 0 where `code` is a byte that is none.
using Escape = std::string (*)(Character);

std::string text_escape(Character c) {
  if (c.code == '\n') return "\\n";
  if (c.code == '\r') return "\\r";
  if (c.code == '\t') return "\\t";
  const auto code = static_cast<unsigned>(c.code);
  if (c.bytes < 2) return fmt::format("\\x{:02x}", code);
  return code < 0x10000 ? fmt::format("\\u{:04x}", code) : fmt::format("\\U{:08x}", code);
}

std::string line_escape(Character c) { return c.code == '\n' ? "\n" : text_escape(c); }

// Between its strings JSON has line ends and nothing else that is not printable; in them it has escaped these itself.
std::string json_escape(Character c) {
  if (c.code == '\n') return "\n";
  const auto code = static_cast<unsigned>(c.code);
  if (code < 0x10000) return fmt::format("\\u{:04x}", code);
  return fmt::format("\\u{:04x}\\u{:04x}", 0xD800 + ((code - 0x10000) >> 10), 0xDC00 + (code & 0x3FF));
}

std::string escaped(std::string_view text, Escape escape) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    Character c = first_character(text);
    if (c.bytes == 0) c.code = static_cast<unsigned char>(text[0]);
    const auto bytes = static_cast<std::size_t>(std::max(c.bytes, 1));
    if (c.bytes > 0 && is_printable(c.code))
      out += text.substr(0, bytes);
    else
      out += escape(c);
    text.remove_prefix(bytes);
  }
  return out;
}

void write_out(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size())
    throw std::system_error(errno, std::generic_category(), "the output could not be written");
}

Remarks chosen_remarks = Remarks::lines;

void write_aside(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace

std::string printable(std::string_view text) { return escaped(text, text_escape); }

std::string printable_lines(std::string_view text) { return escaped(text, line_escape); }

std::string printable_json(std::string_view json) { return escaped(json, json_escape); }

void print_text(std::string_view lines) { write_out(printable_lines(lines)); }

void print_json(std::string_view json) { write_out(printable_json(json) + "\n"); }

void say_text(std::string_view lines) { write_aside(printable_lines(lines)); }

void say_message(std::string_view line) {
  constexpr std::size_t longest = 4000;
  const std::string text = printable(line);
  if (text.size() <= longest) return write_aside(text + "\n");
  std::size_t head = longest * 3 / 4, tail = text.size() - longest / 4;
  while (is_continuation(text[head])) --head;
  while (tail < text.size() && is_continuation(text[tail])) ++tail;
  const std::string_view shown = text;
  write_aside(fmt::format("{} … {}\n", shown.substr(0, head), shown.substr(tail)));
}

void say_json(std::string_view json) { write_aside(printable_json(json) + "\n"); }

void choose_remarks(Remarks manner) { chosen_remarks = manner; }

Remarks remarks() { return chosen_remarks; }

void say_remark(const std::string& line) {
  switch (chosen_remarks) {
    case Remarks::lines:
      return say_message(line);
    case Remarks::json:
      return say_json(json_text(nlohmann::json{{"message", line}}));
    case Remarks::none:
      return;
  }
}

void wipe_line() { write_aside(wipe); }

void redraw_line(std::string_view line) { write_aside(fmt::format("{}{}", wipe, printable(line))); }

}  // namespace billow::cli
