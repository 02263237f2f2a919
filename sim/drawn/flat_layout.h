// A mesh laid flat: where its particles lie in the texture square, and whether they lie there as a grid.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// Places in [0, 1]^2, u to the right and v up: the texture coordinates scaled to fill the square, or, without any, the
/// plane of the mesh's largest extent.
struct FlatLayout {
  Eigen::MatrixX2d vertex;                             // (v x 2) at its first corner, where a seam gives it several
  std::vector<std::array<Eigen::Vector2d, 4>> corner;  // (f)
};
FlatLayout flat_layout(const Mesh& mesh);

/// Vertices in rows of equal height from the top, each row from left to right, when all rows are equally long: a
/// regular grid. Empty otherwise.
std::vector<std::vector<int>> grid_rows(const Eigen::MatrixX2d& flat);

}  // namespace billow::sim
