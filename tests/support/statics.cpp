// Assembled in triplets; conjugate gradients, because springs through a solid leave no sparse factor.
#include "tests/support/statics.h"

#include <Eigen/Sparse>
#include <stdexcept>

namespace billow::test {

namespace {

// df/dx of a spring of stiffness k with rest length L at length l: k n n^T + k (1 - L / l) (I - n n^T).
Eigen::Matrix3d block(const sim::Structure& structure, int s) {
  const Eigen::RowVector3d way =
      structure.rest_position.row(structure.spring(s, 1)) - structure.rest_position.row(structure.spring(s, 0));
  const Eigen::Vector3d n = way.normalized().transpose();
  const Eigen::Matrix3d along = n * n.transpose();
  const double sideways = 1.0 - structure.rest_length(s) / way.norm();
  return structure.stiffness(s) * (along + sideways * (Eigen::Matrix3d::Identity() - along));
}

}  // namespace

Loading no_load(const sim::Structure& structure) {
  const int n = structure.particles();
  return {Eigen::MatrixX3d::Zero(n, 3), Eigen::Array<bool, Eigen::Dynamic, 3>::Constant(n, 3, false),
          Eigen::MatrixX3d::Zero(n, 3)};
}

Eigen::MatrixX3d holding_forces(const sim::Structure& structure, const Eigen::MatrixX3d& u) {
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(structure.particles(), 3);
  for (int s = 0; s < structure.springs(); ++s) {
    const int i = structure.spring(s, 0), j = structure.spring(s, 1);
    const Eigen::RowVector3d pull = (u.row(j) - u.row(i)) * block(structure, s);
    force.row(j) += pull;
    force.row(i) -= pull;
  }
  return force;
}

Eigen::MatrixX3d displacements(const sim::Structure& structure, const Loading& loading) {
  Eigen::MatrixX3d u = Eigen::MatrixX3d::Zero(structure.particles(), 3);
  Eigen::MatrixX3i unknown = Eigen::MatrixX3i::Constant(structure.particles(), 3, -1);
  int count = 0;
  for (int i = 0; i < structure.particles(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (loading.held(i, axis))
        u(i, axis) = loading.displacement(i, axis);
      else
        unknown(i, axis) = count++;
  const Eigen::MatrixX3d missing = loading.force - holding_forces(structure, u);
  Eigen::VectorXd right(count);
  std::vector<Eigen::Triplet<double>> entries;
  for (int s = 0; s < structure.springs(); ++s) {
    const Eigen::Matrix3d k = block(structure, s);
    for (const int p : {0, 1})
      for (const int q : {0, 1})
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) {
            const int row = unknown(structure.spring(s, p), a), column = unknown(structure.spring(s, q), b);
            if (row >= 0 && column >= 0) entries.emplace_back(row, column, (p == q ? 1.0 : -1.0) * k(a, b));
          }
  }
  for (int i = 0; i < structure.particles(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (unknown(i, axis) >= 0) right(unknown(i, axis)) = missing(i, axis);
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(matrix);
  solver.setTolerance(1e-8);
  solver.setMaxIterations(20000);
  const Eigen::VectorXd solution = solver.solve(right);
  if (solver.info() != Eigen::Success) throw std::runtime_error("no equilibrium was found");
  for (int i = 0; i < structure.particles(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (unknown(i, axis) >= 0) u(i, axis) = solution(unknown(i, axis));
  return u;
}

}  // namespace billow::test
