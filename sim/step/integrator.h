// One interface for every time-integration scheme. None knows the filter, nor what else acts on its velocities.
#pragma once

#include <Eigen/Core>
#include <string_view>

#include "base/words.h"
#include "sim/step/step_forces.h"

namespace billow::sim {

/// How the implicit schemes solve their linear system.
enum class LinearSolver { conjugate_gradient, cholesky };
Words<LinearSolver> words(LinearSolver);

struct IntegratorOptions {
  LinearSolver linear_solver = LinearSolver::conjugate_gradient;
  double tolerance = 0.01;    // relative residual of the conjugate gradient, as in the paper
  int max_iterations = 1000;  // of the conjugate gradient
};

/// What the linear solves of a run came to. Explicit schemes leave it at zero.
struct SolveCounts {
  long solves = 0, iterations = 0;
  long tightened = 0;    // conjugate gradient, to less than its tolerance: what was left would have added energy
  long by_cholesky = 0;  // handed over by a conjugate gradient that broke down, ran out of iterations or stayed harmful
  long failures = 0;     // by neither

  SolveCounts& operator+=(const SolveCounts& other) {
    solves += other.solves, iterations += other.iterations, tightened += other.tightened;
    by_cholesky += other.by_cholesky, failures += other.failures;
    return *this;
  }
};

/// How positions go on once the new velocities are final: x += by_old v + by_new v', v and v' being the velocities
/// before and after the step.
struct Move {
  double by_old = 0.0, by_new = 0.0;  // [s]
};

/// A time-stepping scheme with its scratch space. Pinned particles keep position and velocity.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// velocity (n x 3) = the new velocities of a step of h [s] from `state`, whose velocity is left as it was; its
  /// position goes as far as it can without them. Returns what is left to move. state.time may be left at any stage of
  /// the step.
  virtual Move integrate(StepForces& forces, State& state, double h, Eigen::MatrixX3d& velocity) = 0;

  /// What earlier steps left behind goes: the next one depends on its state alone.
  virtual void forget() {}

  virtual SolveCounts solve_counts() const { return {}; }
};

}  // namespace billow::sim
