// Values at a cloth's particles, laid out over the texture square as a picture.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// A width x height grid of cells over the flat mesh, row by row from the top. On a regular, even grid each cell is a
/// particle; on any other mesh, about as many cells as particles, evenly spaced from border to border, each
/// interpolated in the face that it lies in.
struct GridSampling {
  int width = 0, height = 0;
  Eigen::SparseMatrix<double, Eigen::RowMajor> weight;  // (cells x v)
  std::vector<bool> covered;                            // (cells) false: outside the cloth

  /// values (v x 3) -> (cells x 3). Cells outside the cloth take the mean of those in it, which adds no frequencies
  /// but those of the cloth's outline.
  Eigen::MatrixX3d sample(const Eigen::MatrixX3d& values) const;
};

GridSampling grid_sampling(const Mesh& mesh);

}  // namespace billow::sim
