// scenes/golden.schema.json and docs/golden.md say what the reader of tests does.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/golden/golden_keys.h"
#include "cli/golden/image_tolerance.h"
#include "tests/support/schema.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

using Json = nlohmann::json;

Json golden_schema() { return test::schema("golden.schema.json"); }

TEST(GoldenSchema, HasTheReadersKeysRangesAndWords) {
  const Json root = golden_schema();
  test::expect_same_keys(cli::keys::golden, root, "");
  const Json& parts = root["definitions"];
  test::expect_same_keys(cli::keys::golden_scene, parts["scene"], "scene");
  test::expect_same_keys(cli::keys::golden_folder, parts["folder"], "folder");
  test::expect_same_keys(cli::keys::golden_command, parts["command"], "command");
  test::expect_same_keys(cli::tolerance_keys(), parts["tolerance"], "tolerance");
  test::expect_same_keys(cli::metric_keys(), parts["tolerance"]["properties"]["metrics"], "metrics");
}

TEST(GoldenSchema, HasTheReadersDefaults) {
  const Json properties = golden_schema()["definitions"]["tolerance"]["properties"];
  const cli::ImageTolerance usual;
  EXPECT_EQ(properties["channel"]["default"], usual.what.threshold);
  EXPECT_EQ(properties["worst"]["default"], usual.allowed.worst);
  EXPECT_EQ(properties["pixels"]["default"], "1%");
  EXPECT_EQ(usual.allowed.share, 0.01);
  EXPECT_EQ(properties["ignore_alpha"]["default"], usual.what.ignore_alpha);
}

TEST(GoldenSchema, IsNamedByTheTestsThatShip) {
  std::ifstream stream(BILLOW_SOURCE_DIR "/tests/golden/goldens.yaml");
  std::string first;
  std::getline(stream, first);
  EXPECT_EQ(first, "# yaml-language-server: $schema=../../scenes/golden.schema.json");
}

TEST(GoldenFormat, ExplainsEveryKeyAndWord) {
  const std::string text = test::read_text(BILLOW_SOURCE_DIR "/docs/golden.md");
  for (const cli::Section* section :
       {&cli::keys::golden, &cli::keys::golden_scene, &cli::keys::golden_folder, &cli::keys::golden_command})
    for (const cli::Key& key : section->keys) {
      EXPECT_NE(text.find("| `" + std::string(key.name) + "` |"), std::string::npos) << key.name;
      for (const std::string_view word : key.choices)
        EXPECT_NE(text.find("`" + std::string(word) + "`"), std::string::npos) << key.name << ": " << word;
    }
}

}  // namespace
}  // namespace billow
