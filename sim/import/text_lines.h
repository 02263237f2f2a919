// Lines of OBJ and MTL files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace billow::sim {

/// A line without its comment, cut into words.
struct TextLine {
  int number = 0;                       // counted from 1; the last of those that a backslash joins
  std::vector<std::string_view> words;  // at least one
  std::string_view rest;                // what follows the first word, without blanks around it
};

/// The lines of a text that hold words; those that a backslash continues are joined, comments run from # on.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : text_(text) {}

  /// Goes to the next line that holds words; false at the end.
  bool next();
  /// Valid until `next` is called again.
  const TextLine& line() const { return line_; }

 private:
  bool next_joined();
  void split();

  std::string_view text_;
  std::size_t at_ = 0;
  std::string joined_;
  std::string_view content_;
  TextLine line_;
};

}  // namespace billow::sim
