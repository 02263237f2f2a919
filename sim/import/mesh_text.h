// Text as mesh files hold it: any encoding and line end in, words and numbers with their lines out.
#pragma once

#include <string>
#include <string_view>

namespace billow::sim {

/// `bytes` as UTF-8 without a byte-order mark and with \n at line ends: UTF-16 (by its mark, or by the zeros of its
/// letters) and lines that end in \r or \r\n are rewritten.
std::string plain_text(std::string bytes);

/// Blank or line end.
inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

/// The number that `word` writes: decimal, perhaps with a sign and an exponent; infinite or NaN where it says so or is
/// too large. Throws InputError on anything else, with a word on decimal commas.
double number_in(std::string_view word);
/// The whole number that `word` writes. Throws InputError on anything else.
long long integer_in(std::string_view word);

/// The words of a text, one after the other, across lines. A comment runs from `comment` to the end of its line.
class TextWords {
 public:
  explicit TextWords(std::string_view text, char comment = '#', int first_line = 1)
      : text_(text), comment_(comment), line_(first_line) {}

  /// The next word; "" at the end.
  std::string_view next();
  /// Whether another word follows, on this line or a later one.
  bool more();
  /// Whether another word follows on the line of the last one.
  bool more_on_line();
  /// The next word as a number. Throws InputError that names the line, where it is none or the text has ended;
  /// `what` says what it should have been.
  double number(std::string_view what);
  long long integer(std::string_view what);
  /// The line on which the last word stands.
  int line() const { return line_; }
  /// How many bytes of the text are behind.
  std::size_t passed() const { return at_; }

 private:
  void skip(bool across_lines);
  std::string_view need(std::string_view what);

  std::string_view text_;
  char comment_;
  std::size_t at_ = 0;
  int line_;
};

}  // namespace billow::sim
