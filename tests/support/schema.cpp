// What a schema says, and what a table of keys does.
#include "tests/support/schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace billow::test {

namespace {

using Json = nlohmann::json;

// What a property says of its numbers and words, wherever in its lists and alternatives; sections below say their own.
struct Said {
  std::vector<double> min, above, max;
  std::vector<std::string> words;
};

void collect(const Json& node, Said& said) {
  if (node.contains("properties")) return;
  if (node.contains("minimum")) said.min.push_back(node["minimum"]);
  if (node.contains("exclusiveMinimum")) said.above.push_back(node["exclusiveMinimum"]);
  if (node.contains("maximum")) said.max.push_back(node["maximum"]);
  if (node.contains("type") && node["type"] == "boolean") said.words.insert(said.words.end(), {"true", "false"});
  for (const Json& word : node.value("enum", Json::array()))
    said.words.push_back(word.is_string() ? word.get<std::string>() : word.dump());
  for (const Json& alternative : node.value("anyOf", Json::array())) collect(alternative, said);
  if (!node.contains("items")) return;
  if (node["items"].is_array())
    collect(node["items"][0], said);  // a tuple: its first place has the key's range
  else
    collect(node["items"], said);
}

void expect_same(const cli::Key& key, const Json& property) {
  Said said;
  collect(property, said);
  const auto all_are = [](const std::vector<double>& values, double wanted) {
    return std::all_of(values.begin(), values.end(), [&](double value) { return value == wanted; });
  };
  EXPECT_TRUE(all_are(said.max, key.range.max));
  EXPECT_EQ(said.max.empty(), std::isinf(key.range.max));
  EXPECT_TRUE(all_are(key.range.above_min ? said.above : said.min, key.range.min));
  EXPECT_TRUE((key.range.above_min ? said.min : said.above).empty());
  if (property.contains("type") && (property["type"] == "string" || property["type"] == "boolean")) return;
  EXPECT_EQ(said.words, std::vector<std::string>(key.choices.begin(), key.choices.end()));
}

}  // namespace

Json schema(const std::string& name) {
  std::ifstream stream(BILLOW_SOURCE_DIR "/scenes/" + name);
  return Json::parse(stream);
}

const Json& as_object(const Json& node) {
  if (node.contains("anyOf"))
    for (const Json& alternative : node["anyOf"])
      if (alternative.contains("properties")) return alternative;
  return node;
}

const Json& section_of(const Json& root, std::string path) {
  const Json* node = &root;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('.'), path.size());
    std::string key = path.substr(0, end);
    path.erase(0, end + 1);
    const bool entries = key.ends_with("[]");
    if (entries) key.erase(key.size() - 2);
    node = &as_object(*node).at("properties").at(key);
    if (entries) node = &node->at("items");
  }
  return as_object(*node);
}

void expect_same_keys(const cli::Section& section, const Json& object, const std::string& path) {
  for (const cli::Key& key : section.keys) {
    SCOPED_TRACE(path + "." + std::string(key.name));
    ASSERT_TRUE(object["properties"].contains(key.name));
    const Json& property = object["properties"][std::string(key.name)];
    EXPECT_FALSE(property.value("description", "").empty());
    if (!property.contains("const")) expect_same(key, property);
  }
  EXPECT_EQ(object["properties"].size(), section.keys.size()) << path;
  EXPECT_EQ(object["additionalProperties"], false) << path;
}

}  // namespace billow::test
