// Backward Euler, linearised once per step (Baraff & Witkin 1998): with K = -df/dx and C = -df/dv,
// (M + h C + h^2 K) dv = h (f - h K v), v' = v + dv, x' = x + h v'. Order 1, unconditionally stable on the linear
// problem, damps every frequency. K is taken in its definite form.
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <optional>
#include <vector>

#include "sim/linear/block_jacobi.h"
#include "sim/linear/conjugate_gradient.h"
#include "sim/step/schemes.h"

namespace billow::sim {

namespace {

std::vector<int> pinned_particles(const Structure& structure) {
  std::vector<int> pinned;
  for (int i = 0; i < structure.particles(); ++i)
    if (structure.pinned(i)) pinned.push_back(i);
  return pinned;
}

class BackwardEuler : public Integrator {
 public:
  explicit BackwardEuler(const IntegratorOptions& options) : options_(options) {}

  Move integrate(StepForces& forces, State& state, double h, Eigen::MatrixX3d& velocity) override {
    const Structure& structure = forces.structure();
    if (!system_) prepare(structure);
    forces.linearise(state, 1.0, 0.0, *stiffness_);
    forces.force(state, b_);
    stiffness_->multiply(state.velocity, product_);
    b_ = h * (b_ - h * product_);
    zero_pinned_rows(b_);
    form_system(forces, state, h);
    options_.linear_solver == LinearSolver::cholesky ? solve_directly(structure) : solve_iteratively();
    velocity = state.velocity + change_;
    return {.by_new = h};
  }

  SolveCounts solve_counts() const override { return counts_; }

 private:
  void prepare(const Structure& structure) {
    stiffness_.emplace(structure);
    system_.emplace(*stiffness_);
    pinned_ = pinned_particles(structure);
    previous_change_ = change_ = Eigen::MatrixX3d::Zero(structure.particles(), 3);
  }

  void zero_pinned_rows(Eigen::MatrixX3d& field) const {
    for (const int i : pinned_) field.row(i).setZero();
  }

  // M + h C + h^2 K. Where nothing but friction damps, C costs nothing.
  void form_system(const StepForces& forces, const State& state, double h) {
    const Structure& structure = forces.structure();
    forces.linearise(state, 0.0, h, *system_);
    system_->add_scaled(*stiffness_, h * h);
    for (int i = 0; i < structure.particles(); ++i) system_->add_diagonal(i, structure.mass(i));
  }

  // First guess: the change of velocity goes on as the last two steps had it.
  void solve_iteratively() {
    preconditioner_.set(*system_);
    extrapolate(previous_change_, change_);
    const auto multiply = [this](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
      system_->multiply(x, y);
      zero_pinned_rows(y);
    };
    const auto precondition = [this](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) { preconditioner_.apply(x, y); };
    const ConjugateGradientResult result =
        conjugate_gradient(multiply, precondition, b_, options_.tolerance, options_.max_iterations, change_, space_);
    ++counts_.solves;
    counts_.iterations += result.iterations;
    counts_.failures += !result.converged;
  }

  void solve_directly(const Structure& structure) {
    const Eigen::SparseMatrix<double> a = system_->assemble(true);
    if (!same_pattern(a)) analyse(a);
    factor_.factorize(a);
    ++counts_.solves;
    counts_.failures += factor_.info() != Eigen::Success;
    const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows = b_;
    const Eigen::VectorXd solution = factor_.solve(Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size()));
    change_ = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(solution.data(),
                                                                                          structure.particles(), 3);
  }

  // Springs always fill the same places; what else acts may come and go.
  bool same_pattern(const Eigen::SparseMatrix<double>& a) const {
    return std::equal(outer_.begin(), outer_.end(), a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1) &&
           std::equal(inner_.begin(), inner_.end(), a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  }

  void analyse(const Eigen::SparseMatrix<double>& a) {
    factor_.analyzePattern(a);
    outer_.assign(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1);
    inner_.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  }

  IntegratorOptions options_;
  SolveCounts counts_;
  std::optional<StiffnessMatrix> stiffness_, system_;  // K, and M + h C + h^2 K
  std::vector<int> pinned_;
  Eigen::MatrixX3d b_, product_, previous_change_, change_;
  BlockJacobi preconditioner_;
  ConjugateGradientSpace space_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
  std::vector<int> outer_, inner_;  // the pattern that has been analysed
};

}  // namespace

std::unique_ptr<Integrator> make_backward_euler(const IntegratorOptions& options) {
  return std::make_unique<BackwardEuler>(options);
}

}  // namespace billow::sim
