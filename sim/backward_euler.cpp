// Backward Euler, linearised once per step (Baraff & Witkin 1998): with K = -df/dx and C = -df/dv,
// (M + h C + h^2 K) dv = h (f - h K v), v' = v + dv, x' = x + h v'. Order 1, unconditionally stable on the linear
// problem, damps every frequency. K is taken in its definite form.
#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <vector>

#include "sim/conjugate_gradient.h"
#include "sim/schemes.h"

namespace billow::sim {

namespace {

void zero_pinned_rows(const Structure& structure, Eigen::MatrixX3d& field) {
  for (int i = 0; i < structure.particles(); ++i)
    if (structure.pinned(i)) field.row(i).setZero();
}

/// The inverse of each 3 x 3 diagonal block: block-Jacobi.
class BlockJacobi {
 public:
  BlockJacobi(const Structure& structure, const StiffnessMatrix& matrix) : inverse_(matrix.diagonal_blocks()) {
    for (int i = 0; i < structure.particles(); ++i) {
      Eigen::Matrix3d block = inverse_.middleRows<3>(3 * i);
      inverse_.middleRows<3>(3 * i) = structure.pinned(i) ? Eigen::Matrix3d::Zero().eval() : block.inverse().eval();
    }
  }
  void apply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const {
    y.resize(x.rows(), 3);
    for (int i = 0; i < x.rows(); ++i)
      y.row(i).noalias() = (inverse_.middleRows<3>(3 * i) * x.row(i).transpose()).transpose();
  }

 private:
  Eigen::MatrixX3d inverse_;  // (3n x 3)
};

class BackwardEuler : public Integrator {
 public:
  explicit BackwardEuler(const IntegratorOptions& options) : options_(options) {}

  void step(const Structure& structure, const Forces& forces, State& state, double h,
            const VelocityHook& velocity_known) override {
    StiffnessMatrix matrix = forces.linearise(state, h * h, h, JacobianForm::definite);
    right_hand_side(structure, forces, state, h);
    for (int i = 0; i < structure.particles(); ++i) matrix.add_diagonal(i, structure.mass(i));
    if (options_.linear_solver == LinearSolver::cholesky)
      solve_directly(structure, matrix);
    else
      solve_iteratively(structure, matrix);
    state.velocity += change_;
    if (velocity_known) velocity_known(state.position, state.velocity);
    state.position += h * state.velocity;
    state.time += h;
  }

  SolveCounts solve_counts() const override { return counts_; }

 private:
  // b = h (f - h K v)
  void right_hand_side(const Structure& structure, const Forces& forces, const State& state, double h) {
    forces.evaluate(state, b_);
    forces.linearise(state, h, 0.0, JacobianForm::definite).multiply(state.velocity, product_);
    b_ = h * (b_ - product_);
    zero_pinned_rows(structure, b_);
  }

  // The last change of velocity is the first guess for this one.
  void solve_iteratively(const Structure& structure, const StiffnessMatrix& matrix) {
    if (change_.rows() != b_.rows()) change_ = Eigen::MatrixX3d::Zero(b_.rows(), 3);
    const BlockJacobi preconditioner(structure, matrix);
    const auto multiply = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
      matrix.multiply(x, y);
      zero_pinned_rows(structure, y);
    };
    const auto precondition = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) { preconditioner.apply(x, y); };
    const ConjugateGradientResult result =
        conjugate_gradient(multiply, precondition, b_, options_.tolerance, options_.max_iterations, change_);
    ++counts_.solves;
    counts_.iterations += result.iterations;
    counts_.failures += !result.converged;
  }

  void solve_directly(const Structure& structure, const StiffnessMatrix& matrix) {
    const Eigen::SparseMatrix<double> a = matrix.assemble(true);
    if (!analysed_) factor_.analyzePattern(a), analysed_ = true;
    factor_.factorize(a);
    ++counts_.solves;
    counts_.failures += factor_.info() != Eigen::Success;
    const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows = b_;
    const Eigen::VectorXd solution = factor_.solve(Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size()));
    change_ = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(solution.data(),
                                                                                          structure.particles(), 3);
  }

  IntegratorOptions options_;
  SolveCounts counts_;
  Eigen::MatrixX3d b_, product_, change_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
  bool analysed_ = false;
};

}  // namespace

std::unique_ptr<Integrator> make_backward_euler(const IntegratorOptions& options) {
  return std::make_unique<BackwardEuler>(options);
}

}  // namespace billow::sim
