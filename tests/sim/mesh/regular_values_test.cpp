// A regular mesh's lengths and areas made equal; what is irregular left alone.
#include "sim/mesh/regular_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "sim/body/cloth.h"
#include "sim/import/mesh_import.h"

namespace billow::sim {
namespace {

using ::testing::ElementsAreArray;

Eigen::VectorXd regular(std::vector<double> values) {
  Eigen::VectorXd result = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  make_regular(result);
  return result;
}

TEST(RegularValues, BecomeTheMiddleOfTheirCopies) {
  const double low = 1.0, middle = 1.0 + 0x1p-15, high = 1.0 + 0x1p-14;
  EXPECT_THAT(regular({low, 2.0, low, 1.0 + 0x1p-17, 2.0, high}),
              ElementsAreArray({middle, 2.0, middle, middle, 2.0, middle}));
}

TEST(RegularValues, DoNotDependOnTheOrder) {
  std::vector<double> values = {3e-3, 3.0001e-3, 0.50002, 0.5, 0.50004, 7.0, 3.0002e-3};
  const Eigen::VectorXd forth = regular(values);
  std::reverse(values.begin(), values.end());
  EXPECT_EQ(forth, Eigen::VectorXd(regular(values).reverse()));
}

TEST(RegularValues, AreLeftAloneWhereTheyRunTogether) {
  const std::vector<double> chain = {1.0, 1.00008, 1.00016}, bridged = {1.0, 1.00016, 1.00008};
  EXPECT_THAT(regular(chain), ElementsAreArray(chain));
  EXPECT_THAT(regular(bridged), ElementsAreArray(bridged));
}

TEST(RegularValues, AreLeftAloneWhereTheyAreMany) {
  std::vector<double> many;
  for (int k = 0; k < 65; ++k) many.push_back(1.0 + 0.01 * k), many.push_back((1.0 + 0.01 * k) * 1.00001);
  EXPECT_THAT(regular(many), ElementsAreArray(many));
  many.resize(128);
  EXPECT_EQ(regular(many)(0), regular(many)(1));
}

int different(const Eigen::VectorXd& values) {
  return static_cast<int>(std::set<double>(values.begin(), values.end()).size());
}

// Its vertices are written with eight decimals and read in single precision.
TEST(RegularValues, AreThoseOfAClothFromAFile) {
  const Structure cloth = build_cloth(import_mesh(BILLOW_SOURCE_DIR "/assets/meshes/cloth_50.obj"), {});
  EXPECT_EQ(different(cloth.rest_length), 3) << "an edge, a diagonal, two edges";
  EXPECT_EQ(different(cloth.mass), 3) << "at corners, at borders, inside";
}

TEST(RegularValues, KeepAnIrregularClothAsItIs) {
  const Mesh mesh = import_mesh(BILLOW_SOURCE_DIR "/assets/meshes/cloth_irregular.obj");
  const Structure cloth = build_cloth(mesh, {});
  for (int s = 0; s < cloth.springs(); ++s)
    EXPECT_EQ(cloth.rest_length(s),
              (mesh.position.row(cloth.spring(s, 1)) - mesh.position.row(cloth.spring(s, 0))).norm());
}

}  // namespace
}  // namespace billow::sim
