// A YAML file as a plain tree in which every node knows where it stands.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace billow::cli {

struct Node;
using NodePtr = std::shared_ptr<Node>;

/// One key of a map, in the file's order.
struct Entry {
  std::string key;
  std::string where;  // of the key
  NodePtr value;
};

/// One value. Aliases share nodes, so a tree is changed by replacing nodes, never in place.
struct Node {
  enum class Kind { null, scalar, list, map };
  Kind kind = Kind::null;
  std::string where;           // "FILE:LINE:COLUMN" (from 1, in characters), or "-D PATH" for an override
  std::string text;            // scalar
  bool quoted = false;         // scalar: text, even when it looks like a number
  std::vector<NodePtr> items;  // list
  std::vector<Entry> entries;  // map, keys unique
  std::size_t size = 1;        // nodes in this tree, an alias counted as often as it is used

  const Entry* find(std::string_view key) const;
};

/// Reads a YAML file with one document. Merge keys (<<) are carried out.
/// Throws InputError, located, on a file that is missing, unreadable, larger than 1 MiB, not UTF-8 text, not valid
/// YAML, more than 32 levels deep, larger than 100,000 nodes with its aliases expanded, or has a key twice.
NodePtr read_yaml_file(const std::filesystem::path& file);

/// The same of what comes through standard input, which messages call <stdin>.
NodePtr read_yaml_input();

/// The same for text; the messages begin with "NAME:LINE:COLUMN: ".
NodePtr parse_yaml(const std::string& text, const std::string& name);

/// The same for the value of an override; every node and message is located at `where`.
NodePtr parse_yaml_value(const std::string& text, const std::string& where);

NodePtr make_scalar(std::string text, bool quoted = false);
NodePtr make_list(std::vector<NodePtr> items);
NodePtr make_map(std::string where = {});

/// The tree as YAML that parse_yaml reads back to the same tree: maps in blocks, lists of scalars on one line.
std::string to_yaml(const Node& root);
/// The same on one line, as the value of a -D.
std::string to_yaml_line(const Node& node);

}  // namespace billow::cli
