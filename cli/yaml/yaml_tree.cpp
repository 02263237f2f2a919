// YAML text -> tree. The only file that knows yaml-cpp, of which it uses the parser's events alone: yaml-cpp's own
// nodes hide duplicate keys and convert "abc" to fallbacks.
#include "cli/yaml/yaml_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "cli/text/text_file.h"

namespace billow::cli {
namespace {

constexpr std::size_t max_depth = 32;
constexpr std::size_t max_nodes = 100'000;
constexpr std::size_t max_keys = 1000;  // of one map; its keys are searched one by one
constexpr std::uintmax_t max_bytes = 1 << 20;

// Where a mark of the parser stands, in the words of the messages.
class Locator {
 public:
  Locator(const std::string& text, std::string name, bool fixed) : name_(std::move(name)), fixed_(fixed) {
    if (fixed_) return;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) lines_.push_back(line);
  }

  std::string at(const YAML::Mark& mark) const {
    if (fixed_) return name_;
    return mark.is_null() ? name_ + ":1:1" : fmt::format("{}:{}:{}", name_, mark.line + 1, column(mark));
  }

 private:
  // yaml-cpp counts bytes, editors count characters. Marks come in order, so the count goes on from the last one:
  // a file that is one long line is still read in linear time.
  std::size_t column(const YAML::Mark& mark) const {
    const std::size_t line = static_cast<std::size_t>(mark.line), bytes = static_cast<std::size_t>(mark.column);
    if (line >= lines_.size() || bytes > lines_[line].size()) return bytes + 1;
    if (line != last_.line || bytes < last_.bytes) last_ = {line, 0, 0};
    const std::string_view since = std::string_view(lines_[line]).substr(last_.bytes, bytes - last_.bytes);
    last_ = {line, bytes, last_.characters + character_count(since)};
    return last_.characters + 1;
  }

  struct Position {
    std::size_t line = 0, bytes = 0, characters = 0;
  };

  std::string name_;
  bool fixed_;
  std::vector<std::string> lines_;
  mutable Position last_;
};

class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const Locator& locator) : locator_(locator) {}

  NodePtr root() const { return root_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (root_) fail(mark, "a second YAML document begins here; a file holds one");
    anchors_.clear();
  }
  void OnDocumentEnd() override {}
  void OnAnchor(const YAML::Mark&, const std::string&) override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const NodePtr node = make(Node::Kind::null, mark, "", anchor);
    // The mark of an empty value is that of the next token: its key says better where it is missing.
    if (!stack_.empty() && stack_.back().pending) node->where = stack_.back().pending->where;
    place(mark, node);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    // Escapes such as "\x01" in a quoted text can hide what the file itself may not hold.
    if (find_non_text(value)) fail(mark, "a text with control characters");
    const NodePtr node = make(Node::Kind::scalar, mark, tag, anchor);
    node->text = value;
    node->quoted = tag == "!";
    place(mark, node);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) fail(mark, "this alias stands inside its own anchor");
    place(mark, found->second);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, make(Node::Kind::list, mark, tag, 0), anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, make(Node::Kind::map, mark, tag, 0), anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override {
    merge(*stack_.back().node);
    close();
  }

 private:
  struct Level {
    NodePtr node;
    YAML::Mark mark;
    YAML::anchor_t anchor;
    std::optional<Entry> pending;  // a map's key that waits for its value
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const {
    throw InputError(locator_.at(mark) + ": " + message);
  }

  NodePtr make(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (!tag.empty() && tag != "?" && tag != "!")
      fail(mark, fmt::format("the tag '{}' is not understood here", shortened(tag)));
    auto node = std::make_shared<Node>();
    node->kind = kind;
    node->where = locator_.at(mark);
    if (anchor != 0) anchors_[anchor] = node;
    return node;
  }

  void open(const YAML::Mark& mark, NodePtr node, YAML::anchor_t anchor) {
    if (stack_.size() >= max_depth) fail(mark, fmt::format("nested more than {} levels deep", max_depth));
    stack_.push_back({std::move(node), mark, anchor, {}});
  }

  // A list or map can be aliased only once it is whole.
  void close() {
    const Level level = std::move(stack_.back());
    stack_.pop_back();
    if (level.anchor != 0) anchors_[level.anchor] = level.node;
    place(level.mark, level.node);
  }

  void place(const YAML::Mark& mark, const NodePtr& node) {
    if (stack_.empty()) {
      root_ = node;
      return;
    }
    Level& level = stack_.back();
    count(mark, *node, *level.node);
    if (level.node->kind == Node::Kind::list) {
      level.node->items.push_back(node);
    } else if (!level.pending) {
      level.pending = new_key(mark, *node, *level.node);
    } else {
      level.pending->value = node;
      level.node->entries.push_back(*std::exchange(level.pending, {}));
    }
  }

  void count(const YAML::Mark& mark, const Node& child, Node& parent) {
    parent.size += child.size;
    if (parent.size > max_nodes) fail(mark, fmt::format("more than {} values, each alias counted in full", max_nodes));
  }

  Entry new_key(const YAML::Mark& mark, const Node& key, const Node& map) const {
    if (key.kind != Node::Kind::scalar) fail(mark, "a key must be a word");
    if (const Entry* first = map.find(key.text))
      fail(mark, fmt::format("duplicate key '{}'; it was first given at {}", shortened(key.text), first->where));
    if (map.entries.size() >= max_keys) fail(mark, fmt::format("a map with more than {} keys", max_keys));
    return {key.text, locator_.at(mark), nullptr};
  }

  // "<<: *base" or "<<: [*first, *second]": keys of the bases that the map does not have itself.
  static void merge(Node& map) {
    const Entry* found = map.find("<<");
    if (!found) return;
    const Entry merged = *found;
    std::erase_if(map.entries, [](const Entry& entry) { return entry.key == "<<"; });
    const bool several = merged.value->kind == Node::Kind::list;
    for (const NodePtr& base : several ? merged.value->items : std::vector{merged.value}) {
      if (base->kind != Node::Kind::map)
        throw InputError(merged.where + ": a merge key (<<) needs a map, or a list of maps");
      for (const Entry& entry : base->entries)
        if (!map.find(entry.key)) map.entries.push_back(entry);
    }
  }

  const Locator& locator_;
  NodePtr root_;
  std::vector<Level> stack_;
  std::map<YAML::anchor_t, NodePtr> anchors_;
};

NodePtr parse(const std::string& text, const Locator& locator) {
  TreeBuilder builder(locator);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}: not valid YAML: {}", locator.at(error.mark), error.msg));
  }
  if (!builder.root()) throw InputError(locator.at(YAML::Mark::null_mark()) + ": there is nothing in it");
  return builder.root();
}

}  // namespace

const Entry* Node::find(std::string_view key) const {
  for (const Entry& entry : entries)
    if (entry.key == key) return &entry;
  return nullptr;
}

NodePtr make_scalar(std::string text, bool quoted) {
  auto node = std::make_shared<Node>();
  node->kind = Node::Kind::scalar;
  node->text = std::move(text);
  node->quoted = quoted;
  return node;
}

NodePtr make_list(std::vector<NodePtr> items) {
  auto node = std::make_shared<Node>();
  node->kind = Node::Kind::list;
  node->items = std::move(items);
  return node;
}

NodePtr make_map(std::string where) {
  auto node = std::make_shared<Node>();
  node->kind = Node::Kind::map;
  node->where = std::move(where);
  return node;
}

NodePtr parse_yaml(const std::string& text, const std::string& name) {
  check_utf8_text(text, name);
  return parse(text, Locator(text, name, false));
}

NodePtr parse_yaml_value(const std::string& text, const std::string& where) {
  if (find_non_text(text)) throw InputError(where + ": the value is not UTF-8 text");
  return parse(text, Locator(text, where, true));
}

NodePtr read_yaml_input() { return parse_yaml(read_standard_input(max_bytes), "<stdin>"); }

NodePtr read_yaml_file(const std::filesystem::path& file) {
  return parse_yaml(read_text_file(file, max_bytes), file.string());
}

}  // namespace billow::cli
