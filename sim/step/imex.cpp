// Implicit-explicit Euler (Eberhardt, Etzmuss & Hauth 2000): a spring's force splits into the linear part k (x_j -
// x_i), taken implicitly, and the rest, -k L u, taken explicitly. The linear part's matrix K_L = sum k (1 -1; -1 1) is
// the same for every state and axis, so (M + h C_L + h^2 K_L) dv = h f - h^2 K_L v is factorised once for a whole run.
// Damping c is implicit through the same kind of matrix, C_L, which bounds the projected one from above. Order 1.
#include <Eigen/SparseCholesky>

#include "sim/force/fluid_friction.h"
#include "sim/linear/conjugate_gradient.h"
#include "sim/step/schemes.h"

namespace billow::sim {

namespace {

// position_weight K_L + velocity_weight (C_L + friction), n x n, one axis.
StiffnessMatrix linear_part(const Structure& structure, double position_weight, double velocity_weight) {
  StiffnessMatrix matrix(structure);
  for (int s = 0; s < structure.springs(); ++s)
    matrix.add_spring(s, Eigen::Vector3d::Zero(),
                      position_weight * structure.stiffness(s) + velocity_weight * structure.damping(s), 0.0);
  add_friction(structure, velocity_weight, matrix);
  return matrix;
}

class Imex : public Integrator {
 public:
  explicit Imex(const IntegratorOptions& options) : options_(options) {}

  Move integrate(StepForces& forces, State& state, double h, Eigen::MatrixX3d& velocity) override {
    const Structure& structure = forces.structure();
    if (h != factorised_step_) prepare(structure, h);
    forces.force(state, b_);
    stiffness_->multiply(state.velocity, product_);
    b_ = h * b_ - product_;
    solve(structure);
    velocity = state.velocity + change_;
    return {.by_new = h};
  }

  SolveCounts solve_counts() const override { return counts_; }

 private:
  void prepare(const Structure& structure, double h) {
    stiffness_.emplace(linear_part(structure, h * h, 0.0));
    system_.emplace(linear_part(structure, h * h, h));
    for (int i = 0; i < structure.particles(); ++i) system_->add_diagonal(i, structure.mass(i));
    factorised_step_ = h;
    if (options_.linear_solver == LinearSolver::cholesky) factor_.compute(system_->assemble_one_axis(true));
    Eigen::MatrixX3d straight, mixed;
    system_->diagonal_blocks(straight, mixed);
    inverse_diagonal_ = straight.col(0).cwiseInverse();
    for (int i = 0; i < structure.particles(); ++i)
      if (structure.pinned(i)) inverse_diagonal_(i) = 0.0;
    previous_change_ = change_ = Eigen::MatrixX3d::Zero(structure.particles(), 3);
  }

  void solve(const Structure& structure) {
    for (int i = 0; i < structure.particles(); ++i)
      if (structure.pinned(i)) b_.row(i).setZero();
    ++counts_.solves;
    if (options_.linear_solver == LinearSolver::cholesky)
      change_ = factor_.solve(b_);
    else
      solve_iteratively(structure);
  }

  void solve_iteratively(const Structure& structure) {
    extrapolate(previous_change_, change_);
    const auto multiply = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
      system_->multiply(x, y);
      for (int i = 0; i < structure.particles(); ++i)
        if (structure.pinned(i)) y.row(i).setZero();
    };
    const auto precondition = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
      y = inverse_diagonal_.asDiagonal() * x;
    };
    const ConjugateGradientResult result =
        conjugate_gradient(multiply, precondition, b_, options_.tolerance, options_.max_iterations, change_, space_);
    counts_.iterations += result.iterations;
    counts_.failures += !result.converged;
  }

  IntegratorOptions options_;
  SolveCounts counts_;
  std::optional<StiffnessMatrix> stiffness_, system_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
  Eigen::VectorXd inverse_diagonal_;
  Eigen::MatrixX3d b_, product_, previous_change_, change_;
  ConjugateGradientSpace space_;
  double factorised_step_ = 0.0;
};

}  // namespace

std::unique_ptr<Integrator> make_imex(const IntegratorOptions& options) { return std::make_unique<Imex>(options); }

}  // namespace billow::sim
