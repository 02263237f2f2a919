// scenes/scene.schema.json says what the reader does: the same keys, ranges, words and defaults.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/scene/scene.h"
#include "cli/scene/scene_keys.h"
#include "cli/text/number_text.h"
#include "tests/support/scene_files.h"
#include "tests/support/schema_keys.h"

namespace billow {
namespace {

using Json = nlohmann::json;

Json schema() {
  std::ifstream stream(BILLOW_SOURCE_DIR "/scenes/scene.schema.json");
  return Json::parse(stream);
}

// The alternative of `node` that is a map of keys, or `node` itself.
const Json& as_object(const Json& node) {
  for (const Json& alternative : node.value("anyOf", Json::array()))
    if (alternative.contains("properties")) return *std::find(node["anyOf"].begin(), node["anyOf"].end(), alternative);
  return node;
}

// The schema of a section by its path, such as "bodies[].cloth".
const Json& at(const Json& root, std::string path) {
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

TEST(SceneSchema, HasTheReadersKeysRangesAndWords) {
  const Json root = schema();
  for (const auto& [path, section] : cli::keys::all()) {
    SCOPED_TRACE(path);
    test::expect_keys(*section, at(root, path));
  }
}

// A default of the schema as the effective scene writes it.
std::string as_yaml(const Json& value) {
  if (value.is_number()) return cli::shortest(value.get<double>());
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string list = "[";
  for (const Json& item : value) list += (list.size() > 1 ? ", " : "") + as_yaml(item);
  return list + "]";
}

std::string as_yaml(const cli::Node& node) {
  if (node.kind == cli::Node::Kind::scalar) return node.text;
  std::string list = "[";
  for (const cli::NodePtr& item : node.items) list += (list.size() > 1 ? ", " : "") + as_yaml(*item);
  return list + "]";
}

// Compares the defaults of an object of the schema with a map of an effective scene that gives nothing but a mesh.
void expect_same_defaults(const Json& object, const cli::Node& map) {
  for (const auto& [key, property] : object["properties"].items()) {
    SCOPED_TRACE(key);
    const cli::Entry* entry = map.find(key);
    if (!entry && (key == "cloth" || key == "soft" || key == "fish")) continue;  // a body is one of them
    if (!entry && key == "ratio") continue;  // belongs to levels, which have a test of their own
    ASSERT_TRUE(entry);
    if (entry->value->kind == cli::Node::Kind::map)
      expect_same_defaults(as_object(property), *entry->value);
    else if (property.contains("default"))
      EXPECT_EQ(as_yaml(property["default"]), as_yaml(*entry->value));
    else
      EXPECT_TRUE(key == "billow" || key == "bodies" || key == "mesh" || key == "name" || key == "keys")
          << "has no default";
  }
}

TEST(SceneSchema, HasTheReadersDefaults) {
  const test::SceneFolder folder;
  const auto file = folder.scene(
      "billow: 1\nbodies: [{cloth: {mesh: cloth.obj}}]\nsolver: {filter: {}}\nstrip: {}\n"
      "wind: {gusts: {}}\n");
  const cli::NodePtr effective = cli::parse_yaml(cli::read_scene(file).effective, "effective");
  const Json root = schema();
  expect_same_defaults(root, *effective);
  expect_same_defaults(at(root, "bodies[]"), *effective->find("bodies")->value->items.at(0));
}

TEST(SceneSchema, HasTheReadersDefaultForLevels) {
  const test::SceneFolder folder;
  const auto file =
      folder.scene("billow: 1\nbodies: [{cloth: {mesh: cloth.obj}}]\nsolver: {filter: {kernel: levels}}\n");
  const cli::NodePtr effective = cli::parse_yaml(cli::read_scene(file).effective, "effective");
  const cli::Node& filter = *effective->find("solver")->value->find("filter")->value;
  EXPECT_EQ(as_yaml(at(schema(), "solver.filter")["properties"]["ratio"]["default"]),
            as_yaml(*filter.find("ratio")->value));
  EXPECT_EQ(as_yaml(*filter.find("target")->value), "force");
}

TEST(SceneSchema, HasTheReadersDefaultsForAFish) {
  const test::SceneFolder folder;
  const auto file = folder.scene("billow: 1\nbodies: [{fish: {}}]\n");
  const cli::NodePtr effective = cli::parse_yaml(cli::read_scene(file).effective, "effective");
  const cli::Node& body = *effective->find("bodies")->value->items.at(0);
  expect_same_defaults(at(schema(), "bodies[]"), body);
  const cli::Node& motion = *body.find("fish")->value->find("motion")->value;
  EXPECT_EQ(motion.find("keys")->value->items.size(), 1u);
}

TEST(SceneSchema, HasTheReadersDefaultsForASoftBody) {
  const test::SceneFolder folder;
  folder.write("block.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const auto file = folder.scene("billow: 1\nbodies: [{soft: {mesh: block.obj}}]\n");
  const cli::NodePtr effective = cli::parse_yaml(cli::read_scene(file).effective, "effective");
  expect_same_defaults(at(schema(), "bodies[]"), *effective->find("bodies")->value->items.at(0));
}

TEST(SceneFormat, ExplainsEveryKeyAndWord) {
  std::ifstream stream(BILLOW_SOURCE_DIR "/docs/scene_format.md");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (const auto& [path, section] : cli::keys::all())
    for (const cli::Key& key : section->keys) {
      EXPECT_NE(text.find("| `" + std::string(key.name) + "` |"), std::string::npos) << path << "." << key.name;
      for (const std::string_view word : key.choices)
        EXPECT_NE(text.find("`" + std::string(word) + "`"), std::string::npos)
            << path << "." << key.name << ": " << word;
    }
}

TEST(SceneSchema, IsNamedByEveryShippedScene) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BILLOW_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".yaml") continue;
    std::ifstream stream(entry.path());
    std::string first;
    std::getline(stream, first);
    if (first != "# yaml-language-server: $schema=scene.schema.json") continue;
    ++scenes;
    EXPECT_EQ(test::scene_error(entry.path()), "");
  }
  EXPECT_GE(scenes, 3);
}

}  // namespace
}  // namespace billow
