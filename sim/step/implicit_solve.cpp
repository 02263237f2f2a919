// Solve, ask what the rest would do to the energy, tighten, hand over.
#include "sim/step/implicit_solve.h"

namespace billow::sim {

namespace {

// Beyond this even the residual that the conjugate gradient works with is rounding.
constexpr double least_tolerance = 1e-12;

// The most kinetic energy that what is left of a system may amount to, against that of the change of velocity. Ordinary
// steps never reach it; a sheet of 10^8 N/m then keeps to the energies that Cholesky gives it (implicit_solve_test).
constexpr double most_rest = 10.0;

// What sums over many particles may be wrong by, as a share of what they sum: keeps a motion that loses nothing, such
// as a free flight, from being tightened for its rounding.
constexpr double rounding = 1e-12;

double dot(const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b) { return a.cwiseProduct(b).sum(); }

// x . W x with the diagonal W.
double weighted_square(const Eigen::VectorXd& weight, const Eigen::MatrixX3d& x) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) sum += x.col(axis).cwiseAbs2().dot(weight);
  return sum;
}

std::vector<int> pinned_particles(const Structure& structure) {
  std::vector<int> pinned;
  for (int i = 0; i < structure.particles(); ++i)
    if (structure.pinned(i)) pinned.push_back(i);
  return pinned;
}

}  // namespace

ImplicitSolve::ImplicitSolve(const Structure& structure, const IntegratorOptions& options, ImplicitMatrix& matrix)
    : structure_(structure), options_(options), matrix_(matrix), pinned_(pinned_particles(structure)) {
  system_.multiply = [this](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
    matrix_.multiply(x, y);
    zero_pinned_rows(y);
  };
  system_.precondition = [this](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) { matrix_.precondition(x, y); };
  previous_change_ = change_ = Eigen::MatrixX3d::Zero(structure.particles(), 3);
}

void ImplicitSolve::zero_pinned_rows(Eigen::MatrixX3d& field) const {
  for (const int i : pinned_) field.row(i).setZero();
}

void ImplicitSolve::solve(const Eigen::MatrixX3d& old, Eigen::MatrixX3d& b, Eigen::MatrixX3d& velocity) {
  zero_pinned_rows(b);
  ++counts_.solves;
  if (options_.linear_solver == LinearSolver::conjugate_gradient) {
    if (solve_iteratively(old, b, velocity)) return;
    ++counts_.by_cholesky;
  }
  counts_.failures += !solve_directly(b);
  velocity = old + change_;
}

// First guess: the change of velocity goes on as the last two steps had it.
bool ImplicitSolve::solve_iteratively(const Eigen::MatrixX3d& old, const Eigen::MatrixX3d& b,
                                      Eigen::MatrixX3d& velocity) {
  extrapolate(previous_change_, change_);
  gradient_.start(system_, b, change_);
  const bool solved = tighten(old, velocity);
  counts_.iterations += gradient_.iterations();
  return solved;
}

bool ImplicitSolve::tighten(const Eigen::MatrixX3d& old, Eigen::MatrixX3d& velocity) {
  double tolerance = options_.tolerance;
  while (gradient_.solve(tolerance, options_.max_iterations) == SolveState::converged) {
    velocity = old + change_;
    if (rest_is_harmless(velocity)) return true;
    counts_.tightened += tolerance == options_.tolerance;
    tolerance *= 0.1;
    if (tolerance < least_tolerance) break;
  }
  return false;
}

// What the iteration leaves of the system, r = b - A dv, acts on the particles like an impulse -r that no law exerts.
bool ImplicitSolve::rest_is_harmless(const Eigen::MatrixX3d& velocity) {
  const double change = weighted_square(structure_.mass, change_);
  return (!matrix_.linearised() || rest_is_small(change, velocity)) && !rest_adds_energy(change, velocity);
}

// Where no spring holds a particle, all of the impulse turns into speed, and of a b that stiff springs dominate a small
// share is a large one. The linearised step does not mind; but a spring that is turned gets longer with the square of
// the way, so its energy grows with the fourth power.
bool ImplicitSolve::rest_is_small(double change, const Eigen::MatrixX3d& velocity) const {
  const double rest = weighted_square(structure_.inverse_mass, gradient_.residual()) - most_rest * change;
  return rest <= 0.0 || rest <= rounding * weighted_square(structure_.mass, velocity);
}

// With v' = v + dv the energy of the linearised motion changes over the step by
//   - v'.r - 1/2 dv.M dv - 1/2 h^2 v'.K v' - h v'.C v',
// and were r zero, every term would take some: it is to stay so. In terms of A, whose v'.A v' - v'.M v' is
// h v'.C v' + h^2 v'.K v', that is so at the latest when
//   - v'.r <= 1/2 dv.M dv + 1/2 (v'.A v' - v'.M v').
// Most solves pass by the first term alone, which needs no product. IMEX has K_L and C_L for K and C, which are larger.
bool ImplicitSolve::rest_adds_energy(double change, const Eigen::MatrixX3d& velocity) {
  const double gain = -dot(velocity, gradient_.residual()) - 0.5 * change;
  if (gain <= 0.0) return false;
  system_.multiply(velocity, product_);
  const double kinetic_twice = weighted_square(structure_.mass, velocity);
  return !(gain <= 0.5 * (dot(velocity, product_) - kinetic_twice) + rounding * kinetic_twice);
}

// Where this fails too, the last finite iterate stands.
bool ImplicitSolve::solve_directly(const Eigen::MatrixX3d& b) {
  if (!matrix_.solve_directly(b, direct_change_) || !direct_change_.allFinite()) return false;
  change_ = direct_change_;
  return true;
}

}  // namespace billow::sim
