// Typed, checked access to a YAML tree.
#include "cli/yaml/yaml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "base/error.h"
#include "base/suggest.h"
#include "cli/text/number_text.h"
#include "cli/text/text_file.h"

namespace billow::cli {
namespace {

// A value as messages show it.
std::string shown(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return "nothing";
    case Node::Kind::list:
      return "a list";
    case Node::Kind::map:
      return "a map";
    case Node::Kind::scalar:
      break;
  }
  return fmt::format("{1}{0}{1}", shortened(node.text), node.quoted ? '"' : '\'');
}

std::string with_unit(double value, const Range& range) {
  return range.unit.empty() ? shortest(value) : fmt::format("{} {}", shortest(value), range.unit);
}

bool contains(const Range& range, double value) {
  return value <= range.max && (range.above_min ? value > range.min : value >= range.min);
}

std::string described(const Range& range) {
  std::vector<std::string> parts;
  if (range.min > -std::numeric_limits<double>::infinity())
    parts.push_back((range.above_min ? "above " : "at least ") + shortest(range.min));
  if (range.max < std::numeric_limits<double>::infinity()) parts.push_back("at most " + with_unit(range.max, range));
  return fmt::format("{}", fmt::join(parts, " and "));
}

void check_range(const Node& node, std::string_view name, const Range& range, double value) {
  if (!contains(range, value))
    fail_at(node.where, fmt::format("{} is {}; it must be {}", name, with_unit(value, range), described(range)));
}

[[noreturn]] void fail_kind(const Node& node, std::string_view name, std::string_view wanted,
                            std::string_view hint = "") {
  fail_at(node.where, fmt::format("{} must be {}, not {}{}", name, wanted, shown(node), hint));
}

std::string_view hint_for(NumberFault fault) {
  switch (fault) {
    case NumberFault::decimal_comma:
      return "; the decimal sign is a point";
    case NumberFault::leading_zero:
      return "; numbers are decimal and begin with no needless 0";
    case NumberFault::out_of_range:
      return "; that is beyond what a number can hold";
    default:
      return "";
  }
}

void require_plain_scalar(const Node& node, std::string_view name, std::string_view wanted) {
  if (node.kind != Node::Kind::scalar) fail_kind(node, name, wanted);
  if (node.quoted) fail_kind(node, name, wanted, "; leave the quotes out");
}

// "auto, paper or a number" for a key that accepts words too.
std::string with_words(const Key& key, std::string_view kind) {
  return fmt::format("{}{}{}", fmt::join(key.choices, ", "), key.choices.empty() ? "" : " or ", kind);
}

template <class Value, class Read>
Value value_or(const Node* node, std::optional<Value> fallback, const Read& read) {
  return node || !fallback ? read(*node) : *fallback;
}

}  // namespace

void fail_at(const std::string& where, const std::string& message) { throw InputError(where + ": " + message); }

const Key& Section::key(std::string_view wanted) const {
  for (const Key& key : keys)
    if (key.name == wanted) return key;
  throw std::logic_error(fmt::format("the section '{}' has no key '{}'", name, wanted));
}

std::string read_text(const Node& node, std::string_view name) {
  if (node.kind != Node::Kind::scalar) fail_kind(node, name, "a text");
  if (node.text.empty()) fail_at(node.where, fmt::format("{} is empty", name));
  return node.text;
}

double read_number(const Node& node, std::string_view name, const Range& range, std::string_view wanted) {
  require_plain_scalar(node, name, wanted);
  const ParsedNumber number = parse_number(node.text);
  if (number.fault == NumberFault::not_finite) fail_kind(node, name, "a finite number");
  if (number.fault != NumberFault::none) fail_kind(node, name, wanted, hint_for(number.fault));
  check_range(node, name, range, number.value);
  return number.value;
}

int read_integer(const Node& node, std::string_view name, const Range& range) {
  require_plain_scalar(node, name, "a whole number");
  if (!is_whole_number(node.text)) fail_kind(node, name, "a whole number");
  constexpr double largest = std::numeric_limits<int>::max();
  const double value = read_number(
      node, name, {std::max(range.min, -largest), std::min(range.max, largest), range.above_min, range.unit});
  return static_cast<int>(value);
}

Eigen::Vector3d read_vector(const Node& node, std::string_view name, const Range& range) {
  if (node.kind != Node::Kind::list) fail_kind(node, name, "a list [x, y, z]");
  if (node.items.size() != 3)
    fail_at(node.where, fmt::format("{} must be a list [x, y, z], but has {} entries", name, node.items.size()));
  Eigen::Vector3d value;
  for (int axis = 0; axis < 3; ++axis)
    value(axis) = read_number(*node.items[static_cast<std::size_t>(axis)], fmt::format("{}[{}]", name, axis), range);
  return value;
}

const std::vector<NodePtr>& read_list(const Node& node, std::string_view name) {
  if (node.kind != Node::Kind::list) fail_kind(node, name, "a list");
  return node.items;
}

std::string read_word(const Node& node, std::string_view name, const std::vector<std::string_view>& choices) {
  const std::string word = read_text(node, name);
  const auto found = std::find(choices.begin(), choices.end(), word);
  if (found == choices.end())
    fail_at(node.where, fmt::format("unknown {} {}{}", name, shown(node), suggestion(word, choices, "known are")));
  return word;
}

bool is_word(const Node& node, std::string_view word) { return node.kind == Node::Kind::scalar && node.text == word; }

NodePtr record_of(double value) { return make_scalar(shortest(value)); }

NodePtr record_of(const Eigen::Vector3d& value) {
  return make_list({record_of(value.x()), record_of(value.y()), record_of(value.z())});
}

MapReader::MapReader(const Node& node, const Section& section, NodePtr record)
    : MapReader(node, node.where, section, std::move(record)) {}

MapReader::MapReader(const Node& node, std::string where, const Section& section, NodePtr record)
    : node_(node), where_(std::move(where)), section_(section), record_(std::move(record)) {
  if (node.kind != Node::Kind::map) fail_kind(node, section.name, "a map");
  std::vector<std::string_view> known;
  for (const Key& key : section.keys) known.push_back(key.name);
  for (const Entry& entry : node.entries)
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      fail_at(entry.where, fmt::format("unknown key '{}' in {}{}", shortened(entry.key), section.name,
                                       suggestion(entry.key, known, "its keys are")));
}

const std::string& MapReader::where(std::string_view key) const {
  const Entry* entry = node_.find(key);
  return entry ? entry->value->where : where_;
}

const Node* MapReader::find(std::string_view key, std::string_view hint_without_value) const {
  const Entry* entry = node_.find(section_.key(key).name);
  if (!entry) return nullptr;
  if (entry->value->kind == Node::Kind::null)
    fail_at(entry->value->where, fmt::format("{} has no value{}", key, hint_without_value));
  return entry->value.get();
}

const Node& MapReader::require(std::string_view key, std::string_view hint_without) const {
  const Node* node = find(key);
  if (!node) fail_at(where_, fmt::format("{} needs the key '{}'{}", section_.name, key, hint_without));
  return *node;
}

double MapReader::number(std::string_view key, std::optional<double> fallback) {
  const Node* node = fallback ? find(key) : &require(key);
  const Key& known = section_.key(key);
  const double value = value_or(
      node, fallback, [&](const Node& n) { return read_number(n, key, known.range, with_words(known, "a number")); });
  record(key, record_of(value));
  return value;
}

std::optional<double> MapReader::number_or_word(std::string_view key, std::optional<double> fallback) {
  const Node* node = find(key);
  const std::string_view word = section_.key(key).choices.at(0);
  if (node ? !is_word(*node, word) : fallback.has_value()) return number(key, fallback);
  record(key, make_scalar(std::string(word)));
  return std::nullopt;
}

int MapReader::integer(std::string_view key, std::optional<int> fallback) {
  const Node* node = fallback ? find(key) : &require(key);
  const int value =
      value_or(node, fallback, [&](const Node& n) { return read_integer(n, key, section_.key(key).range); });
  record(key, make_scalar(std::to_string(value)));
  return value;
}

bool MapReader::boolean(std::string_view key, bool fallback) {
  const Node* node = find(key);
  if (node && (node->quoted || (!is_word(*node, "true") && !is_word(*node, "false"))))
    fail_kind(*node, key, "true or false");
  const bool value = node ? is_word(*node, "true") : fallback;
  record(key, make_scalar(value ? "true" : "false"));
  return value;
}

std::string MapReader::text(std::string_view key, std::optional<std::string> fallback) {
  const Node* node = fallback ? find(key) : &require(key);
  const std::string value = value_or(node, fallback, [&](const Node& n) { return read_text(n, key); });
  record(key, make_scalar(value));
  return value;
}

Eigen::Vector3d MapReader::vector(std::string_view key, const Eigen::Vector3d& fallback) {
  const Node* node = find(key);
  const Eigen::Vector3d value = node ? read_vector(*node, key, section_.key(key).range) : fallback;
  record(key, record_of(value));
  return value;
}

std::string MapReader::word(std::string_view key, const std::string& fallback) {
  const Node* node = find(key);
  const std::string word = node ? read_word(*node, key, section_.key(key).choices) : fallback;
  record(key, make_scalar(word));
  return word;
}

bool MapReader::is_none(std::string_view key) {
  const Node* node = find(key);
  if (node && !is_word(*node, "none")) return false;
  record(key, make_scalar("none"));
  return true;
}

MapReader MapReader::map_from(const Node* node, std::string_view key, const Section& section) {
  static const Node empty = *make_map();
  if (node && node->kind != Node::Kind::map) fail_kind(*node, key, with_words(section_.key(key), "a map"));
  NodePtr child = make_map();
  record(key, child);
  return {node ? *node : empty, node ? node->where : where_, section, child};
}

void MapReader::record(std::string_view key, NodePtr value) {
  record_->entries.push_back({std::string(section_.key(key).name), {}, std::move(value)});
}

}  // namespace billow::cli
