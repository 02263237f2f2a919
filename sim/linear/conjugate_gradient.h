// Preconditioned conjugate gradient on particle vectors, matrix-free.
#pragma once

#include <Eigen/Core>

#include "sim/linear/particle_operator.h"

namespace billow::sim {

/// A x = b for a symmetric positive definite A, and an approximate inverse of A that is both as well.
struct LinearSystem {
  ParticleOperator multiply, precondition;
};

/// What the iteration came to. A breakdown is final: numbers too large or too small for the squares that it sums, a
/// matrix that is not positive definite along a direction, or a tolerance that rounding keeps it from.
enum class SolveState { converged, out_of_iterations, breakdown };

/// Keeps its vectors between solves, so that they take their memory once. Sums run in a fixed order.
class ConjugateGradient {
 public:
  /// Begins from the given x, or from zero where that leaves no finite residual. All must outlive the iteration.
  void start(const LinearSystem& system, const Eigen::MatrixX3d& b, Eigen::MatrixX3d& x);
  /// Goes on until |b - A x| <= tolerance |b|, or until `max_iterations` have been made since the start. May be called
  /// again with a smaller tolerance. x stays finite whatever happens.
  SolveState solve(double tolerance, int max_iterations);

  int iterations() const { return iterations_; }
  /// b - A x (n x 3).
  const Eigen::MatrixX3d& residual() const { return residual_; }

 private:
  void begin();
  bool is_believed(double target) const;
  bool confirm(double target);
  bool iterate();

  const LinearSystem* system_ = nullptr;
  const Eigen::MatrixX3d* b_ = nullptr;
  Eigen::MatrixX3d* x_ = nullptr;
  Eigen::MatrixX3d residual_, preconditioned_, direction_, product_;
  double b_square_ = 0.0, residual_square_ = 0.0;
  double began_with_ = 0.0;      // residual_square_ when it was last computed from x,
  double largest_square_ = 0.0;  // and the largest of it and b_square_ since
  double rz_ = 0.0;              // residual . preconditioned residual of the last iteration; 0: none yet
  int iterations_ = 0;
  bool broken_ = false;
};

/// The first guess for a sequence of systems that changes slowly: of its last two solutions, `previous` becomes the
/// later one and `current` the next one on the line through both.
void extrapolate(Eigen::MatrixX3d& previous, Eigen::MatrixX3d& current);

}  // namespace billow::sim
