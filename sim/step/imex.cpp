// Implicit-explicit Euler (Eberhardt, Etzmuss & Hauth 2000): a spring's force splits into the linear part k (x_j -
// x_i), taken implicitly, and the rest, -k L u, taken explicitly. The linear part's matrix K_L = sum k (1 -1; -1 1) is
// the same for every state and axis, so (M + h C_L + h^2 K_L) dv = h f - h^2 K_L v is factorised once for a whole run.
// Damping c is implicit through the same kind of matrix, C_L, which bounds the projected one from above. Order 1.
#include <optional>

#include "sim/linear/sparse_cholesky.h"
#include "sim/step/implicit_part.h"
#include "sim/step/implicit_solve.h"
#include "sim/step/schemes.h"

namespace billow::sim {

namespace {

StiffnessMatrix linear_part(const Structure& structure, double position_weight, double velocity_weight) {
  StiffnessMatrix matrix(structure);
  add_implicit_part(structure, position_weight, velocity_weight, matrix);
  return matrix;
}

/// M + h C_L + h^2 K_L, the same for every state.
class ConstantMatrix : public ImplicitMatrix {
 public:
  ConstantMatrix(const Structure& structure, double h) : system_(linear_part(structure, h * h, h)) {
    for (int i = 0; i < structure.particles(); ++i) system_.add_diagonal(i, structure.mass(i));
    Eigen::MatrixX3d straight, mixed;
    system_.diagonal_blocks(straight, mixed);
    inverse_diagonal_ = straight.col(0).cwiseInverse();
  }

  void multiply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const override { system_.multiply(x, y); }
  void precondition(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const override {
    y = inverse_diagonal_.asDiagonal() * x;
  }

  bool solve_directly(const Eigen::MatrixX3d& b, Eigen::MatrixX3d& x) override {
    if (!factor_.ready() && !factor_.factorise(system_.assemble_one_axis(true))) return false;
    x = factor_.solve(b);
    return true;
  }
  bool linearised() const override { return false; }

 private:
  StiffnessMatrix system_;
  Eigen::VectorXd inverse_diagonal_;  // (n)
  SparseCholesky factor_;
};

class Imex : public Integrator {
 public:
  explicit Imex(const IntegratorOptions& options) : options_(options) {}

  Move integrate(StepForces& forces, State& state, double h, Eigen::MatrixX3d& velocity) override {
    if (h != prepared_step_) prepare(forces.structure(), h);
    forces.force(state, b_);
    stiffness_->multiply(state.velocity, product_);
    b_ = h * b_ - product_;
    solve_->solve(state.velocity, b_, velocity);
    return {.by_new = h};
  }

  void forget() override {
    if (solve_) solve_->forget();
  }

  SolveCounts solve_counts() const override { return solve_ ? solve_->counts() : SolveCounts{}; }

 private:
  void prepare(const Structure& structure, double h) {
    stiffness_.emplace(linear_part(structure, h * h, 0.0));
    matrix_.emplace(structure, h);
    if (!solve_) solve_.emplace(structure, options_, *matrix_);
    prepared_step_ = h;
  }

  const IntegratorOptions options_;
  std::optional<StiffnessMatrix> stiffness_;  // h^2 K_L
  std::optional<ConstantMatrix> matrix_;
  std::optional<ImplicitSolve> solve_;
  Eigen::MatrixX3d b_, product_;
  double prepared_step_ = 0.0;
};

}  // namespace

std::unique_ptr<Integrator> make_imex(const IntegratorOptions& options) { return std::make_unique<Imex>(options); }

}  // namespace billow::sim
