// Tree -> YAML text.
#include <algorithm>

#include "cli/text/terminal.h"
#include "cli/yaml/yaml_tree.h"

namespace billow::cli {
namespace {

// Words that every YAML reader takes as they stand; everything else goes between quotes.
bool is_plain(const std::string& text) {
  constexpr std::string_view harmless = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+-";
  if (text.empty() || text.find_first_not_of(harmless) != std::string::npos) return false;
  const bool dash = text[0] == '-' && (text.size() == 1 || text[1] == '-');
  return !dash && text != "null" && text != "Null" && text != "NULL";
}

std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return '"' + printable(out) + '"';
}

std::string key_of(const Entry& entry) { return is_plain(entry.key) ? entry.key : quoted(entry.key); }

std::string scalar(const Node& node) { return node.quoted || !is_plain(node.text) ? quoted(node.text) : node.text; }

bool holds_map(const Node& node) {
  return node.kind == Node::Kind::map ||
         std::any_of(node.items.begin(), node.items.end(), [](const NodePtr& item) { return holds_map(*item); });
}

void write(const Node& node, const std::string& indent, std::string& out);

// What stands after "key:" or "-".
void write_value(const Node& node, const std::string& indent, std::string& out) {
  if (!holds_map(node)) {
    out += " " + to_yaml_line(node) + "\n";
    return;
  }
  out += "\n";
  write(node, indent + "  ", out);
}

void write(const Node& node, const std::string& indent, std::string& out) {
  for (const Entry& entry : node.entries) {
    out += indent + key_of(entry) + ":";
    write_value(*entry.value, indent, out);
  }
  for (const NodePtr& item : node.items) {
    const std::size_t begin = out.size();
    out += indent + "-";
    write_value(*item, indent, out);
    // "-\n    name: drape" reads better as "-\n" joined: "  - name: drape".
    if (holds_map(*item)) out.erase(begin + indent.size() + 1, 1 + indent.size() + 1);
  }
}

}  // namespace

std::string to_yaml_line(const Node& node) {
  if (node.kind == Node::Kind::scalar || node.kind == Node::Kind::null) return scalar(node);
  const bool list = node.kind == Node::Kind::list;
  std::string out = list ? "[" : "{";
  for (const NodePtr& item : node.items) out += (out.size() > 1 ? ", " : "") + to_yaml_line(*item);
  for (const Entry& entry : node.entries)
    out += (out.size() > 1 ? ", " : "") + key_of(entry) + ": " + to_yaml_line(*entry.value);
  return out + (list ? "]" : "}");
}

std::string to_yaml(const Node& root) {
  std::string out;
  write(root, "", out);
  return out;
}

}  // namespace billow::cli
