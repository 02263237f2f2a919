// Typed, checked access to a YAML tree: every value has a kind and a range, every fault its place in the file, and
// every value read is written down again, defaults included.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/words.h"
#include "cli/yaml/yaml_tree.h"

namespace billow::cli {

/// The numbers a key accepts, and their unit.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool above_min = false;  // min itself is excluded
  std::string_view unit = {};
};

/// One key of a map.
struct Key {
  std::string_view name;
  Range range = {};                            // of its number, or of each number in its list
  std::vector<std::string_view> choices = {};  // the words it accepts, alone or beside a number
};

/// The keys that a map may have.
struct Section {
  std::string_view name;  // as messages say it: "unknown key 'stifness' in NAME"
  std::vector<Key> keys;

  const Key& key(std::string_view name) const;
};

/// Throws InputError "WHERE: MESSAGE".
[[noreturn]] void fail_at(const std::string& where, const std::string& message);

/// A single value as text, whole number or number, `name` being what messages call it. Throws InputError.
std::string read_text(const Node& node, std::string_view name);
int read_integer(const Node& node, std::string_view name, const Range& range);
double read_number(const Node& node, std::string_view name, const Range& range, std::string_view wanted = "a number");
/// A list of exactly three numbers.
Eigen::Vector3d read_vector(const Node& node, std::string_view name, const Range& range);
/// The entries of a list.
const std::vector<NodePtr>& read_list(const Node& node, std::string_view name);
/// A word that is one of `choices`.
std::string read_word(const Node& node, std::string_view name, const std::vector<std::string_view>& choices);
/// The value that a word stands for (base/words.h).
template <class Enum>
Enum read_choice(const Node& node, std::string_view name) {
  const std::string word = read_word(node, name, all_words<Enum>());
  for (const Word<Enum>& known : words(Enum{}))
    if (known.text == word) return known.value;
  throw std::logic_error("a word has no value");
}
/// True for the word `word`, in quotes or not.
bool is_word(const Node& node, std::string_view word);

NodePtr record_of(double value);
NodePtr record_of(const Eigen::Vector3d& value);

/// One map of the file against its section. Getters without a default throw InputError when the key is missing.
/// What they return is also entered in `record`, in the order of the calls.
class MapReader {
 public:
  /// Throws InputError when `node` is no map or has a key that the section does not know.
  MapReader(const Node& node, const Section& section, NodePtr record);
  MapReader(const MapReader&) = delete;
  MapReader& operator=(const MapReader&) = delete;

  /// Where the value of `key` stands, or the map when it is missing.
  const std::string& where(std::string_view key) const;
  const std::string& where() const { return where_; }
  /// The value of `key`, null when the key is missing. Throws InputError on a key without a value.
  const Node* find(std::string_view key, std::string_view hint_without_value = "") const;
  const Node& require(std::string_view key, std::string_view hint_without = "") const;

  double number(std::string_view key, std::optional<double> fallback = {});
  /// A number, or the key's one word for nothing, which is also the default where there is no other.
  std::optional<double> number_or_word(std::string_view key, std::optional<double> fallback = {});
  int integer(std::string_view key, std::optional<int> fallback = {});
  bool boolean(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::optional<std::string> fallback = {});
  Eigen::Vector3d vector(std::string_view key, const Eigen::Vector3d& fallback);
  /// One of the key's words.
  std::string word(std::string_view key, const std::string& fallback);
  /// The value that one of an enumeration's words stands for.
  template <class Enum>
  Enum choice(std::string_view key, Enum fallback) {
    const Node* node = find(key);
    const Enum value = node ? read_choice<Enum>(*node, key) : fallback;
    record(key, make_scalar(std::string(word_of(value))));
    return value;
  }
  /// The map under `key`, empty when the key is missing; its record is entered in this one.
  MapReader map(std::string_view key, const Section& section) { return map_from(find(key), key, section); }
  /// The same, but read from `node`, null meaning empty: for values that are short for a map.
  MapReader map_from(const Node* node, std::string_view key, const Section& section);

  /// Whether `key` is missing or says `none`, which is then entered.
  bool is_none(std::string_view key);

  /// Enters a value that the caller has read from find() or require() itself.
  void record(std::string_view key, NodePtr value);
  const Key& key(std::string_view name) const { return section_.key(name); }
  const NodePtr& record() const { return record_; }

 private:
  MapReader(const Node& node, std::string where, const Section& section, NodePtr record);

  const Node& node_;
  std::string where_;  // of the map, or of the next map around it that the file has
  const Section& section_;
  NodePtr record_;
};

}  // namespace billow::cli
