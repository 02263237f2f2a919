// Levels as dense matrices.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/levels/level_hierarchy.h"

namespace billow::test {

/// `rows` as a matrix of so many columns.
Eigen::MatrixXd dense(const sim::SparseRows& rows, int columns);

/// P of every level: how the body's particles follow its nodes. The first is the particles themselves: 1.
std::vector<Eigen::MatrixXd> interpolations(const sim::LevelHierarchy& hierarchy, int particles);

}  // namespace billow::test
