// The table of views, and the words of a scene's picture settings.
#include "render/image/views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "render/image/settings.h"

namespace billow::render {
namespace {

TEST(Views, HaveARowForEveryEnumerator) {
  for (const View view : {View::textured, View::velocity, View::data, View::depth, View::normal, View::id})
    EXPECT_EQ(row_of(view).view, view);
  EXPECT_THROW(row_of(static_cast<View>(-1)), std::logic_error);
}

TEST(Views, DifferInNameAndFolder) {
  std::set<View> enumerators;
  std::set<std::string_view> names, folders;
  for (const ViewRow& row : views()) {
    EXPECT_TRUE(enumerators.insert(row.view).second) << row.name;
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(folders.insert(row.folder).second) << row.folder;
  }
}

// Scenes and the folders of earlier runs hold these.
TEST(Views, KeepTheirNamesAndFolders) {
  EXPECT_EQ(name(View::textured), "textured");
  EXPECT_EQ(name(View::velocity), "velocity");
  EXPECT_EQ(folder(View::textured), "textured");
  EXPECT_EQ(folder(View::velocity), "velocity");
  EXPECT_EQ(folder(View::data), "data");
}

TEST(Views, AllButDataArePngFiles) {
  EXPECT_THAT(png_views(), testing::ElementsAre("textured", "velocity", "depth", "normal", "id"));
  EXPECT_EQ(row_of(View::data).extension, ".exr");
}

TEST(Views, AreWrittenByTheirNames) {
  EXPECT_EQ(all_words<View>().size(), views().size());
  for (const ViewRow& row : views()) EXPECT_EQ(word_of(row.view), row.name);
}

TEST(VelocityColour, HasItsWords) {
  EXPECT_EQ(word_of(VelocityColour::components), "components");
  EXPECT_EQ(word_of(VelocityColour::magnitude), "magnitude");
  EXPECT_THAT(all_words<VelocityColour>(), testing::ElementsAre("magnitude", "components"));
}

}  // namespace
}  // namespace billow::render
