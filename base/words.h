// The words that scenes, studies and reports use for the values of an enumeration, bound to them by name.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace billow {

template <class Enum>
struct Word {
  std::string_view text;
  Enum value;
};

/// An enumeration that can be written has a function `Words<Enum> words(Enum)` beside it, whatever it is given: all its
/// words, in the order in which messages list them.
template <class Enum>
using Words = std::span<const Word<Enum>>;

/// The word for `value`. Throws std::logic_error when it has none.
template <class Enum>
std::string_view word_of(Enum value) {
  for (const Word<Enum>& word : words(value))
    if (word.value == value) return word.text;
  throw std::logic_error("a value of an enumeration has no word");
}

/// All words of the enumeration.
template <class Enum>
std::vector<std::string_view> all_words() {
  std::vector<std::string_view> all;
  for (const Word<Enum>& word : words(Enum{})) all.push_back(word.text);
  return all;
}

/// The row of a table for an enumerator, which stands in each row's member `key`. Throws std::logic_error where there
/// is none.
template <class Row, std::size_t rows, class Enum>
constexpr const Row& row_for(const Row (&table)[rows], Enum Row::*key, Enum value) {
  for (const Row& row : table)
    if (row.*key == value) return row;
  throw std::logic_error("an enumerator has no row in its table");
}

/// The words of a table: of each row, its name for its enumerator.
template <class Row, std::size_t rows, class Enum>
constexpr std::array<Word<Enum>, rows> words_of(const Row (&table)[rows], std::string_view Row::*name, Enum Row::*key) {
  std::array<Word<Enum>, rows> words{};
  for (std::size_t r = 0; r < rows; ++r) words[r] = {table[r].*name, table[r].*key};
  return words;
}

}  // namespace billow
