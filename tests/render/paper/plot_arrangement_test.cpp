// How many curves of how many kinds are told apart.
#include "render/paper/plot_arrangement.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace billow::render {
namespace {

Dimension of_size(int size, bool own_scale = false) {
  return {std::vector<std::string>(static_cast<std::size_t>(size), "value"), own_scale};
}

// All combinations of the dimensions' values.
std::vector<std::vector<int>> combinations(const std::vector<Dimension>& dimensions) {
  std::vector<std::vector<int>> all{{}};
  for (const Dimension& dimension : dimensions) {
    std::vector<std::vector<int>> longer;
    for (const std::vector<int>& at : all)
      for (int v = 0; v < static_cast<int>(dimension.values.size()); ++v) {
        longer.push_back(at);
        longer.back().push_back(v);
      }
    all = std::move(longer);
  }
  return all;
}

// No two curves look the same in the same panel, and no panel has more than can be told apart.
void expect_tellable(const std::vector<Dimension>& dimensions) {
  const Arrangement arrangement = arranged(dimensions);
  std::map<int, std::set<std::pair<int, int>>> looks;
  for (const std::vector<int>& at : combinations(dimensions)) {
    const Look look = look_of(arrangement, dimensions, at);
    EXPECT_TRUE(looks[look.panel].emplace(look.colour, look.mark).second);
    EXPECT_LT(look.colour, most_colours);
    EXPECT_LT(look.mark, most_colours);
    EXPECT_LT(look.panel, arrangement.panels);
  }
  for (const auto& [panel, inside] : looks) EXPECT_LE(static_cast<int>(inside.size()), most_in_a_panel);
}

TEST(PlotArrangement, TellsAllCurvesApart) {
  for (const std::vector<int>& sizes : std::vector<std::vector<int>>{{},
                                                                     {1},
                                                                     {8},
                                                                     {9},
                                                                     {40},
                                                                     {3, 4},
                                                                     {4, 4},
                                                                     {6, 6},
                                                                     {7, 11},
                                                                     {3, 40},
                                                                     {40, 3},
                                                                     {3, 3, 4},
                                                                     {12, 12, 12},
                                                                     {1, 5, 1},
                                                                     {2, 2, 2, 2},
                                                                     {10, 9, 8, 7}})
    for (const bool own_scale : {false, true}) {
      std::vector<Dimension> dimensions;
      for (const int size : sizes) dimensions.push_back(of_size(size));
      if (own_scale) dimensions.push_back(of_size(2, true));
      SCOPED_TRACE(testing::PrintToString(sizes));
      expect_tellable(dimensions);
    }
}

TEST(PlotArrangement, GivesTheFirstColoursTheSecondMarksAndTheThirdPanels) {
  const std::vector<Dimension> dimensions = {of_size(3), of_size(3), of_size(4)};
  const Arrangement arrangement = arranged(dimensions);
  EXPECT_EQ(arrangement.panels, 4);
  const Look look = look_of(arrangement, dimensions, {1, 2, 3});
  EXPECT_EQ(look.colour, 1);
  EXPECT_EQ(look.mark, 2);
  EXPECT_EQ(look.panel, 3);
  EXPECT_EQ(shared_values(arrangement, dimensions, 3), std::vector<int>{3});
}

TEST(PlotArrangement, TellsOneDimensionByColourAndMarkAtOnce) {
  const std::vector<Dimension> dimensions = {of_size(5)};
  const Look look = look_of(arranged(dimensions), dimensions, {4});
  EXPECT_EQ(look.colour, 4);
  EXPECT_EQ(look.mark, 4);
}

TEST(PlotArrangement, GivesWhatSharesNoScalePanelsOfItsOwn) {
  const std::vector<Dimension> dimensions = {of_size(2), of_size(2, true)};
  const Arrangement arrangement = arranged(dimensions);
  EXPECT_EQ(arrangement.panels, 2);
  EXPECT_EQ(arrangement.by_panel, std::vector<int>{1});
}

TEST(PlotArrangement, GoesOnInTheNextPanelWhereColoursRunOut) {
  const std::vector<Dimension> dimensions = {of_size(40)};
  const Arrangement arrangement = arranged(dimensions);
  EXPECT_EQ(arrangement.panels, 5);
  EXPECT_EQ(colours_of_panel(arrangement, dimensions, 4), (std::pair{32, 40}));
}

}  // namespace
}  // namespace billow::render
