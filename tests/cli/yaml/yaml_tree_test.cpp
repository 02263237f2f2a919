// YAML text -> tree -> YAML text, and what is refused before it becomes a tree.
#include "cli/yaml/yaml_tree.h"

#include <gtest/gtest.h>

#include <chrono>

#include "base/error.h"
#include "tests/support/mesh_files.h"

namespace billow::cli {
namespace {

std::string error_of(const std::string& yaml) {
  try {
    parse_yaml(yaml, "f");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string file_error(const std::filesystem::path& file) {
  try {
    read_yaml_file(file);
  } catch (const InputError& error) {
    return std::string(error.what()).substr(file.string().size());
  }
  return "";
}

std::string repeated(const std::string& text, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

TEST(YamlTree, KnowsWhereEveryNodeStands) {
  const NodePtr root = parse_yaml("a: 1\n\nb:\n  - é: [x, yé, z]\n", "f");
  const Node& list = *root->find("b")->value;
  const Entry& inner = list.items[0]->entries[0];
  EXPECT_EQ(root->find("a")->where, "f:1:1");
  EXPECT_EQ(root->find("a")->value->where, "f:1:4");
  EXPECT_EQ(list.where, "f:4:3");
  EXPECT_EQ(inner.key, "é");
  EXPECT_EQ(inner.where, "f:4:5");
  EXPECT_EQ(inner.value->items[0]->where, "f:4:9");
  EXPECT_EQ(inner.value->items[2]->where, "f:4:16") << "columns are characters, not bytes";
}

TEST(YamlTree, KeepsQuotedWordsApart) {
  const NodePtr root = parse_yaml("[1, '1', \"1\", ~, null, '']", "f");
  EXPECT_FALSE(root->items[0]->quoted);
  EXPECT_TRUE(root->items[1]->quoted);
  EXPECT_TRUE(root->items[2]->quoted);
  EXPECT_EQ(root->items[3]->kind, Node::Kind::null);
  EXPECT_EQ(root->items[4]->kind, Node::Kind::null);
  EXPECT_EQ(root->items[5]->kind, Node::Kind::scalar);
}

TEST(YamlTree, FollowsAliasesAndMergeKeys) {
  const NodePtr root = parse_yaml(
      "base: &base {mass: 1, bend: 2}\n"
      "more: &more {bend: 3, shear: 4}\n"
      "one: {<<: *base, mass: 9}\n"
      "two: {<<: [*base, *more]}\n"
      "same: *base\n",
      "f");
  const Node& one = *root->find("one")->value;
  EXPECT_EQ(one.find("mass")->value->text, "9");
  EXPECT_EQ(one.find("bend")->value->text, "2");
  EXPECT_EQ(one.find("bend")->where, "f:1:23") << "a merged key stands where it was written";
  const Node& two = *root->find("two")->value;
  EXPECT_EQ(two.find("bend")->value->text, "2") << "the first base wins";
  EXPECT_EQ(two.find("shear")->value->text, "4");
  EXPECT_EQ(two.find("<<"), nullptr);
  EXPECT_EQ(root->find("same")->value, root->find("base")->value);
}

TEST(YamlTree, RefusesWhatIsNoText) {
  EXPECT_EQ(error_of(std::string("a: 1\nb\0: 2\n", 11)), "f:2:2: byte 0x00 does not belong in UTF-8 text");
  EXPECT_EQ(error_of("a: \xff"), "f:1:4: byte 0xff does not belong in UTF-8 text");
  EXPECT_EQ(error_of("é: \xc3"), "f:1:4: byte 0xc3 does not belong in UTF-8 text");
  EXPECT_EQ(error_of("\xc0\xaf"), "f:1:1: byte 0xc0 does not belong in UTF-8 text") << "overlong";
  EXPECT_EQ(error_of("\xed\xa0\x80"), "f:1:1: byte 0xed does not belong in UTF-8 text") << "a surrogate";
  EXPECT_EQ(error_of("\xf4\x90\x80\x80"), "f:1:1: byte 0xf4 does not belong in UTF-8 text") << "past U+10FFFF";
  EXPECT_EQ(error_of("\xff\xfe"
                     "a"),
            "f:1:1: byte 0xff does not belong in UTF-8 text")
      << "UTF-16";
  EXPECT_EQ(error_of("\xef\xbb\xbf"
                     "a: 1"),
            "")
      << "a byte-order mark is fine";
  EXPECT_EQ(error_of("a: 1\r\nb: 2\r\n"), "");
}

TEST(YamlTree, RefusesEmptyText) {
  for (const char* text : {"", "\n\n", "# nothing\n"}) EXPECT_EQ(error_of(text), "f:1:1: there is nothing in it");
}

TEST(YamlTree, RefusesFilesItCannotRead) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(file_error(folder.path() / "missing.yaml"), ": no such file");
  EXPECT_EQ(file_error(folder.path()), ": this is a folder, not a file");
  EXPECT_EQ(file_error("/dev/zero"), ": this is not a regular file");
  EXPECT_EQ(file_error(folder.write("large.yaml", std::string((1 << 20) + 1, ' '))),
            ": larger than 1024 KiB; this is no scene");
  EXPECT_EQ(file_error(folder.write("full.yaml", "a: 1" + std::string((1 << 20) - 4, ' '))), "");
}

// Each of these makes a careless reader run for ever, out of memory or out of stack.
TEST(YamlTree, RefusesBombsWithinASecond) {
  std::string aliases = "a: &a [x, x, x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c <= 'k'; ++c) {
    const std::string previous = std::string("*") + static_cast<char>(c - 1);
    aliases += std::string(1, c) + ": &" + c + " [" + previous + repeated(", " + previous, 9) + "]\n";
  }
  std::string keys;
  for (int i = 0; i < 80000; ++i) keys += "k" + std::to_string(i) + ": 1\n";
  const int mebibyte = 1 << 20;
  const std::vector<std::pair<std::string, std::string>> bombs{
      {aliases, "f:5:44: more than 100000 values, each alias counted in full"},
      {"a: &a [*a]", "f:1:8: this alias stands inside its own anchor"},
      {"a: &a {b: *a}", "f:1:11: this alias stands inside its own anchor"},
      {repeated("[", mebibyte), "f:1:17: nested more than 32 levels deep"},
      {repeated("{", mebibyte), "f:1:32: nested more than 32 levels deep"},
      {repeated("- ", mebibyte / 2), "f:1:65: nested more than 32 levels deep"},
      {repeated("? ", mebibyte / 2), "f:1:65: nested more than 32 levels deep"},
      {keys, "f:1001:1: a map with more than 1000 keys"},
      {repeated("- 1\n", mebibyte / 4), "f:100000:3: more than 100000 values, each alias counted in full"},
      {"[" + repeated("é,", mebibyte / 3 - 1) + "]", "f:1:200000: more than 100000 values, each alias counted in full"},
      {repeated("---\n", mebibyte / 4), "f:2:1: a second YAML document begins here; a file holds one"},
  };
  for (const auto& [text, message] : bombs) {
    SCOPED_TRACE(text.substr(0, 20));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(error_of(text), message);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5))
        << "a second, with room for a busy machine";
  }
}

TEST(YamlTree, WritesWhatItReadsBack) {
  const NodePtr root = parse_yaml(
      "{name: drape, list: [1, -2.5, [a, b], 'two words'], empty: [],\n"
      " maps: [{first: 1, second: {deep: x}}, {first: '#', second: \"a\\\\b\\n\"}]}",
      "f");
  const std::string written = to_yaml(*root);
  EXPECT_EQ(written,
            "name: drape\n"
            "list: [1, -2.5, [a, b], \"two words\"]\n"
            "empty: []\n"
            "maps:\n"
            "  - first: 1\n"
            "    second:\n"
            "      deep: x\n"
            "  - first: \"#\"\n"
            "    second: \"a\\\\b\\n\"\n");
  EXPECT_EQ(to_yaml(*parse_yaml(written, "f")), written);
}

TEST(YamlTree, WritesOutWhatIsNotPrintable) {
  const NodePtr root = parse_yaml(R"({"a: b": "\u202e\x9b\U000e0041ä", list: [{"\u200b": 1}]})", "f");
  const std::string line = to_yaml_line(*root);
  EXPECT_EQ(line, R"({"a: b": "\u202e\u009b\U000e0041ä", list: [{"\u200b": 1}]})");
  EXPECT_EQ(to_yaml_line(*parse_yaml(line, "f")), line);
  EXPECT_EQ(to_yaml(*parse_yaml(to_yaml(*root), "f")), to_yaml(*root));
}

TEST(YamlTree, QuotesWordsThatWouldReadAsSomethingElse) {
  for (const std::string word : {"-",  "--", "~",  "null", "a: b", "a #b", "#a",  "[a", "*a", "&a", "!a",
                                 "%a", "@a", "'a", " a",   "a ",   "é",    "a,b", "<<", "?",  "|",  ">"}) {
    SCOPED_TRACE(word);
    NodePtr map = make_map();
    map->entries.push_back({"key", {}, make_list({make_scalar(word)})});
    const NodePtr back = parse_yaml(to_yaml(*map), "f");
    EXPECT_EQ(back->find("key")->value->items.at(0)->text, word);
  }
}

}  // namespace
}  // namespace billow::cli
