// "-D key.path=value": changes to a tree before anything in it is checked.
#include "cli/yaml/yaml_overrides.h"

#include <fmt/format.h>

#include <charconv>

#include "base/error.h"
#include "base/suggest.h"
#include "cli/text/number_text.h"
#include "cli/text/text_file.h"

namespace billow::cli {
namespace {

constexpr std::size_t max_path_keys = 32;

// One override on its way down the tree.
struct Path {
  std::string where;              // "-D solver.step"
  std::vector<std::string> keys;  // solver, step
  NodePtr value;

  [[noreturn]] void fail(const std::string& message) const { throw InputError(where + ": " + message); }
  std::string upto(std::size_t depth) const {
    return depth == 0 ? "the file" : fmt::format("{}", fmt::join(keys.begin(), keys.begin() + depth, "."));
  }
};

Path parse_override(const Override& change) {
  Path path{change.where.empty() ? "-D " + change.path : change.where, {}, nullptr};
  for (std::size_t begin = 0; begin <= change.path.size();) {
    const std::size_t end = std::min(change.path.find('.', begin), change.path.size());
    path.keys.push_back(change.path.substr(begin, end - begin));
    if (path.keys.back().empty()) path.fail("a key is missing in the path");
    if (path.keys.size() > max_path_keys) path.fail(fmt::format("a path of more than {} keys", max_path_keys));
    begin = end + 1;
  }
  path.value = change.node ? change.node : parse_yaml_value(change.value, path.where);
  return path;
}

std::string_view name_of(const Node& item) {
  const Entry* name = item.find("name");
  return name && name->value->kind == Node::Kind::scalar ? std::string_view(name->value->text) : std::string_view();
}

std::vector<std::string_view> names(const Node& list) {
  std::vector<std::string_view> found;
  for (const NodePtr& item : list.items)
    if (!name_of(*item).empty()) found.push_back(name_of(*item));
  return found;
}

std::size_t item_index(const Node& list, const Path& path, std::size_t depth) {
  const std::string& key = path.keys[depth];
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  if (error == std::errc() && end == key.data() + key.size() && index < list.items.size()) return index;
  for (std::size_t i = 0; i < list.items.size(); ++i)
    if (name_of(*list.items[i]) == key) return i;
  const std::size_t count = list.items.size();
  const std::string entries = count == 1 ? "one entry, 0" : fmt::format("{} entries, from 0", count);
  path.fail(fmt::format("{} has {}; none is '{}'{}", path.upto(depth), entries, shortened(key),
                        names(list).empty() ? "" : suggestion(key, names(list), "named")));
}

NodePtr changed(const NodePtr& node, const Path& path, std::size_t depth);

NodePtr changed_map(const Node& map, const Path& path, std::size_t depth) {
  auto copy = std::make_shared<Node>(map);
  for (Entry& entry : copy->entries) {
    if (entry.key != path.keys[depth]) continue;
    entry.value = changed(entry.value, path, depth + 1);
    return copy;
  }
  copy->entries.push_back({path.keys[depth], path.where, changed(nullptr, path, depth + 1)});
  return copy;
}

NodePtr changed_list(const Node& list, const Path& path, std::size_t depth) {
  auto copy = std::make_shared<Node>(list);
  NodePtr& item = copy->items[item_index(list, path, depth)];
  item = changed(item, path, depth + 1);
  return copy;
}

// `node` with the rest of the path applied; copies what lies on the path only, for aliases share the rest.
NodePtr changed(const NodePtr& node, const Path& path, std::size_t depth) {
  if (depth == path.keys.size()) return path.value;
  if (!node || node->kind == Node::Kind::null) return changed_map(*make_map(path.where), path, depth);
  if (node->kind == Node::Kind::map) return changed_map(*node, path, depth);
  if (node->kind == Node::Kind::list) return changed_list(*node, path, depth);
  path.fail(fmt::format("{} is '{}' (at {}) and has no keys", path.upto(depth), shortened(node->text), node->where));
}

}  // namespace

NodePtr with_overrides(const NodePtr& root, const std::vector<Override>& overrides) {
  NodePtr tree = root;
  for (const Override& change : overrides) tree = changed(tree, parse_override(change), 0);
  return tree;
}

void add_overrides(const std::vector<Override>& overrides, std::vector<std::string>& words) {
  for (const Override& change : overrides) words.insert(words.end(), {"-D", change.path + "=" + change.value});
}

}  // namespace billow::cli
