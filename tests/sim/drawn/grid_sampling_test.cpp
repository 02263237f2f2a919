// Particles laid out as a picture.
#include "sim/drawn/grid_sampling.h"

#include "sim/import/mesh_import.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

namespace fs = std::filesystem;

Mesh shipped(const std::string& name) { return import_mesh(fs::path(BILLOW_SOURCE_DIR) / "assets/meshes" / name); }

TEST(GridSampling, OfARegularGridTakesEveryParticleOnce) {
  const Mesh mesh = shipped("cloth_20.obj");
  const GridSampling grid = grid_sampling(mesh);
  EXPECT_EQ(grid.width, 20);
  EXPECT_EQ(grid.height, 20);
  const Eigen::MatrixX3d cells = grid.sample(mesh.position);
  EXPECT_TRUE((cells.row(0) - mesh.position.row(0)).norm() == 0.0);  // the upper left corner is the first vertex
  Eigen::VectorXd taken = grid.weight.transpose() * Eigen::VectorXd::Ones(400);
  EXPECT_TRUE((taken.array() == 1.0).all());
}

// Rows of equal length that grow wider downwards are no image until they are resampled.
TEST(GridSampling, OfAnUnevenGridIsInterpolated) {
  Mesh mesh = test::quad_grid(9, 9);
  mesh.uv.clear();
  mesh.position.col(2) = mesh.position.col(2).array().square().eval();
  const GridSampling grid = grid_sampling(mesh);
  const Eigen::MatrixX3d cells = grid.sample(mesh.position);
  for (int y = 0; y < grid.height; ++y) EXPECT_NEAR(cells(y * grid.width, 2), 8.0 * y, 1e-9);
}

// Interpolation within faces is exact for fields that are linear over the cloth.
TEST(GridSampling, OfAnIrregularMeshIsExactForLinearFields) {
  const Mesh mesh = shipped("cloth_irregular.obj");
  const GridSampling grid = grid_sampling(mesh);
  ASSERT_EQ(grid.width, 52);  // sqrt(2658)
  const Eigen::MatrixX3d cells = grid.sample(mesh.position);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      ASSERT_TRUE(grid.covered[y * grid.width + x]);
      const Eigen::RowVector3d exact(x / (grid.width - 1.0) - 0.5, 0.0, y / (grid.height - 1.0));
      ASSERT_LT((cells.row(y * grid.width + x) - exact).norm(), 1e-5) << x << ", " << y;
    }
}

// Outside the cloth stands the mean of what is inside.
TEST(GridSampling, FillsHolesWithTheMean) {
  const Mesh mesh = shipped("tablecloth_round.obj");
  const GridSampling grid = grid_sampling(mesh);
  const Eigen::MatrixX3d ones = Eigen::MatrixX3d::Constant(mesh.vertices(), 3, 0.3);
  EXPECT_LT((grid.sample(ones).array() - 0.3).abs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace billow::sim
