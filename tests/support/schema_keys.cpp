// Properties against keys.
#include "tests/support/schema_keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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
  if (node.value("type", "") == "boolean") said.words.insert(said.words.end(), {"true", "false"});
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
  if (const std::string type = property.value("type", ""); type == "string" || type == "boolean") return;
  EXPECT_EQ(said.words, std::vector<std::string>(key.choices.begin(), key.choices.end()));
}

}  // namespace

void expect_keys(const cli::Section& section, const Json& object) {
  for (const cli::Key& key : section.keys) {
    SCOPED_TRACE(key.name);
    ASSERT_TRUE(object["properties"].contains(key.name));
    const Json& property = object["properties"][std::string(key.name)];
    EXPECT_FALSE(property.value("description", "").empty());
    expect_same(key, property);
  }
  EXPECT_EQ(object["properties"].size(), section.keys.size());
  EXPECT_EQ(object["additionalProperties"], false);
}

}  // namespace billow::test
