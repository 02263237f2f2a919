// Backward Euler, linearised once per step (Baraff & Witkin 1998): with K = -df/dx and C = -df/dv,
// (M + h C + h^2 K) dv = h (f - h K v), v' = v + dv, x' = x + h v'. Order 1, unconditionally stable on the linear
// problem, damps every frequency. K is taken in its definite form.
#include <optional>

#include "sim/linear/sparse_cholesky.h"
#include "sim/step/implicit_solve.h"
#include "sim/step/schemes.h"
#include "sim/step/two_level.h"

namespace billow::sim {

namespace {

// Particle-major: the three components of a particle lie side by side.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// M + h C + h^2 K at one state.
class LinearisedMatrix : public ImplicitMatrix {
 public:
  explicit LinearisedMatrix(const Structure& structure)
      : stiffness_(structure), system_(stiffness_), preconditioner_(structure) {}

  // After a solve that took so many `iterations`. Where nothing but friction damps, C costs nothing.
  void form(const StepForces& forces, const State& state, double h, long iterations) {
    const Structure& structure = forces.structure();
    forces.linearise(state, 1.0, 0.0, stiffness_);
    forces.linearise(state, 0.0, h, system_);
    system_.add_scaled(stiffness_, h * h);
    for (int i = 0; i < structure.particles(); ++i) system_.add_diagonal(i, structure.mass(i));
    preconditioner_.set(system_, iterations);
  }

  void forget() { preconditioner_.forget(); }

  const StiffnessMatrix& stiffness() const { return stiffness_; }

  void multiply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const override { system_.multiply(x, y); }
  void precondition(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const override { preconditioner_.apply(x, y); }

  bool solve_directly(const Eigen::MatrixX3d& b, Eigen::MatrixX3d& x) override {
    if (!factor_.factorise(system_.assemble(true))) return false;
    const Rows rows = b;
    const Eigen::VectorXd solution = factor_.solve(Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size()));
    x = Eigen::Map<const Rows>(solution.data(), b.rows(), 3);
    return true;
  }
  bool linearised() const override { return true; }

 private:
  StiffnessMatrix stiffness_, system_;  // K, and all of it
  mutable TwoLevel preconditioner_;     // its scratch
  SparseCholesky factor_;
};

class BackwardEuler : public Integrator {
 public:
  explicit BackwardEuler(const IntegratorOptions& options) : options_(options) {}

  Move integrate(StepForces& forces, State& state, double h, Eigen::MatrixX3d& velocity) override {
    if (!solve_) {
      matrix_.emplace(forces.structure());
      solve_.emplace(forces.structure(), options_, *matrix_);
    }
    matrix_->form(forces, state, h, last_iterations_);
    forces.force(state, b_);
    matrix_->stiffness().multiply(state.velocity, product_);
    b_ = h * (b_ - h * product_);
    const long before = solve_->counts().iterations;
    solve_->solve(state.velocity, b_, velocity);
    last_iterations_ = solve_->counts().iterations - before;
    return {.by_new = h};
  }

  void forget() override {
    if (solve_) solve_->forget(), matrix_->forget();
    last_iterations_ = 0;
  }

  SolveCounts solve_counts() const override { return solve_ ? solve_->counts() : SolveCounts{}; }

 private:
  const IntegratorOptions options_;
  std::optional<LinearisedMatrix> matrix_;
  std::optional<ImplicitSolve> solve_;
  Eigen::MatrixX3d b_, product_;
  long last_iterations_ = 0;
};

}  // namespace

std::unique_ptr<Integrator> make_backward_euler(const IntegratorOptions& options) {
  return std::make_unique<BackwardEuler>(options);
}

}  // namespace billow::sim
