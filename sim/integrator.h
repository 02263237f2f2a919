// One interface for every time-integration scheme. None knows the filter.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string_view>

#include "sim/forces.h"
#include "sim/state.h"
#include "sim/structure.h"

namespace billow::sim {

enum class Method { forward_euler, fb_euler, verlet, rk4, backward_euler, imex };

/// The method's name as scenes and reports write it.
std::string_view name(Method method);

/// How the implicit schemes solve their linear system.
enum class LinearSolver { conjugate_gradient, cholesky };

struct IntegratorOptions {
  LinearSolver linear_solver = LinearSolver::conjugate_gradient;
  double tolerance = 0.01;    // relative residual of the conjugate gradient, as in the paper
  int max_iterations = 1000;  // of the conjugate gradient
};

/// What the linear solves of a run came to. Explicit schemes leave it at zero.
struct SolveCounts {
  long solves = 0, iterations = 0, failures = 0;  // failures: not converged within max_iterations
};

/// A post-process of the velocities, which a scheme applies as soon as it knows them, before it moves positions by
/// them.
class VelocityFilter {
 public:
  virtual ~VelocityFilter() = default;
  /// velocity (n x 3) <- its filtered one; position (n x 3) is the one the velocities belong to.
  virtual void apply(const Eigen::MatrixX3d& position, Eigen::MatrixX3d& velocity) const = 0;
  /// state.velocity = the filtered `velocity`, then state.position += h state.velocity, in one pass over memory.
  /// `velocity` is left as anything.
  virtual void apply_and_move(Eigen::MatrixX3d& velocity, State& state, double h) const = 0;
};

/// A time-stepping scheme with its scratch space. Pinned particles keep position and velocity.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Advances `state` by h [s]; state.time grows by h. `filter` may be null.
  virtual void step(const Structure& structure, const Forces& forces, State& state, double h,
                    const VelocityFilter* filter) = 0;

  virtual SolveCounts solve_counts() const { return {}; }
};

/// A new integrator of the given scheme for structures of any size.
std::unique_ptr<Integrator> make_integrator(Method method, const IntegratorOptions& options = {});

/// True for the schemes whose step is bounded by the stiffness.
bool is_explicit(Method method);

/// The undamped limit omega h of the scheme's literature: 2 for the Euler kind and Verlet (the paper's equation 11),
/// 2 sqrt 2 for RK4; none for the implicit schemes.
std::optional<double> paper_limit(Method method);

}  // namespace billow::sim
