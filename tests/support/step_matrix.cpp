// Unit vectors through the real step.
#include "tests/support/step_matrix.h"

#include <Eigen/Eigenvalues>

namespace billow::test {

using sim::State;
using sim::Structure;

namespace {

std::vector<int> free_particles(const Structure& structure) {
  std::vector<int> free;
  for (int i = 0; i < structure.particles(); ++i)
    if (!structure.pinned(i)) free.push_back(i);
  return free;
}

State zero_state(const Structure& structure) {
  const Eigen::MatrixX3d zero = Eigen::MatrixX3d::Zero(structure.particles(), 3);
  return {zero, zero, 0.0};
}

}  // namespace

Eigen::MatrixXd step_matrix(const Structure& structure, const LinearStep& step, double h, double time_scale) {
  const std::vector<int> free = free_particles(structure);
  const int half = 3 * static_cast<int>(free.size());
  Eigen::MatrixXd matrix(2 * half, 2 * half);
  for (int c = 0; c < 2 * half; ++c) {
    State state = zero_state(structure);
    const int row = free[c % half / 3], axis = c % 3;
    if (c < half)
      state.position(row, axis) = 1.0;
    else
      state.velocity(row, axis) = 1.0 / time_scale;
    step(state, h);
    for (int r = 0; r < half; ++r) {
      matrix(r, c) = state.position(free[r / 3], r % 3);
      matrix(half + r, c) = time_scale * state.velocity(free[r / 3], r % 3);
    }
  }
  return matrix;
}

double spectral_radius(const Eigen::MatrixXd& matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues().cwiseAbs().maxCoeff();
}

double least_eigenvalue(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
}

Eigen::MatrixXd dense_dynamics(const Structure& structure, const sim::StiffnessMatrix& stiffness) {
  const std::vector<int> free = free_particles(structure);
  const int size = 3 * static_cast<int>(free.size());
  Eigen::MatrixXd matrix(size, size);
  Eigen::MatrixX3d product;
  for (int c = 0; c < size; ++c) {
    Eigen::MatrixX3d unit = Eigen::MatrixX3d::Zero(structure.particles(), 3);
    unit(free[c / 3], c % 3) = 1.0;
    stiffness.multiply(unit, product);
    for (int r = 0; r < size; ++r) matrix(r, c) = structure.inverse_mass(free[r / 3]) * product(free[r / 3], r % 3);
  }
  return matrix;
}

}  // namespace billow::test
