// scenes/study.schema.json says what the reader of studies does: the same keys, ranges, words and defaults.
#include <gtest/gtest.h>

#include <fstream>

#include "cli/study/study.h"
#include "cli/study/study_keys.h"
#include "tests/support/scene_files.h"
#include "tests/support/schema.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json study_schema() { return test::schema("study.schema.json"); }

// The alternative of pictures[] that is of this kind.
const Json& picture_of(const Json& root, std::string_view kind) {
  for (const Json& picture : root.at("properties").at("pictures").at("items").at("anyOf"))
    if (picture.at("properties").at("kind").at("const") == kind) return picture;
  throw std::out_of_range("no such picture");
}

TEST(StudySchema, HasTheReadersKeysRangesAndWords) {
  const Json root = study_schema();
  for (const auto& [path, section] : cli::keys::sections_of_a_study())
    test::expect_same_keys(*section, test::section_of(root, path), path);
}

TEST(StudySchema, HasEveryKindOfPicture) {
  const Json root = study_schema();
  for (const Word<cli::PictureKind>& kind : words(cli::PictureKind{}))
    test::expect_same_keys(cli::keys::picture(kind.value), picture_of(root, kind.text), std::string(kind.text));
  EXPECT_EQ(root["properties"]["pictures"]["items"]["anyOf"].size(), words(cli::PictureKind{}).size());
}

TEST(StudySchema, HasTheReadersDefaults) {
  test::SceneFolder folder;
  folder.scene(test::base_scene);
  const cli::Study study = cli::read_study(folder.write(
      "study.yaml", "billow_study: 1\nscene: scene.yaml\npictures: [{name: p, kind: frames, times: [0]}]\n"));
  const Json root = study_schema();
  const Json& measure = test::section_of(root, "measure")["properties"];
  EXPECT_EQ(measure["render"]["default"], study.measures.render);
  EXPECT_EQ(measure["measured"]["default"], study.measures.measured);
  EXPECT_EQ(measure["repeats"]["default"], study.measures.repeats);
  EXPECT_EQ(root["properties"]["about"]["default"], study.about);
  EXPECT_EQ(picture_of(root, "frames")["properties"]["views"]["default"], study.pictures.front().views);
}

TEST(StudyFormat, ExplainsEveryKeyAndWord) {
  const std::string text = test::read_text(BILLOW_SOURCE_DIR "/docs/study_format.md");
  std::vector<const cli::Section*> sections;
  for (const auto& [path, section] : cli::keys::sections_of_a_study()) sections.push_back(section);
  for (const Word<cli::PictureKind>& kind : words(cli::PictureKind{}))
    sections.push_back(&cli::keys::picture(kind.value));
  for (const cli::Section* section : sections)
    for (const cli::Key& key : section->keys) {
      EXPECT_NE(text.find("`" + std::string(key.name) + "`"), std::string::npos) << section->name << "." << key.name;
      for (const std::string_view word : key.choices)
        EXPECT_NE(text.find("`" + std::string(word) + "`"), std::string::npos) << key.name << ": " << word;
    }
}

TEST(StudySchema, IsNamedByEveryShippedStudy) {
  int studies = 0;
  for (const auto& entry : fs::directory_iterator(BILLOW_SOURCE_DIR "/scenes/studies")) {
    std::ifstream stream(entry.path());
    std::string first;
    std::getline(stream, first);
    EXPECT_EQ(first, "# yaml-language-server: $schema=../study.schema.json") << entry.path();
    EXPECT_NO_THROW(cli::read_study(entry.path())) << entry.path();
    ++studies;
  }
  EXPECT_GE(studies, 8);
}

}  // namespace
}  // namespace billow
