// Entry by entry, level by level.
#include "tests/support/dense_levels.h"

namespace billow::test {

Eigen::MatrixXd dense(const sim::SparseRows& rows, int columns) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows.rows(), columns);
  for (int r = 0; r < rows.rows(); ++r)
    for (int e = rows.first[r]; e < rows.first[r + 1]; ++e) matrix(r, rows.column[e]) += rows.weight[e];
  return matrix;
}

std::vector<Eigen::MatrixXd> interpolations(const sim::LevelHierarchy& hierarchy, int particles) {
  std::vector<Eigen::MatrixXd> p{Eigen::MatrixXd::Identity(particles, particles)};
  for (const sim::NodeLevel& level : hierarchy.level) p.push_back(p.back() * dense(level.interpolation, level.nodes()));
  return p;
}

}  // namespace billow::test
