// A run of the linearised step that shows whether it grows.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "sim/limit/linearised_step.h"
#include "sim/step/step.h"

namespace billow::sim {

/// Runs the linearised step and measures its growth. Each trial starts from what grew most in the one before it, so
/// later ones see growth sooner.
class GrowthTrial {
 public:
  /// `step` must outlive this.
  GrowthTrial(const LinearisedStep& step, std::uint64_t seed);

  /// sqrt(k0) [1/s]
  double omega() const { return omega_; }

  /// Whether steps of h [s] grow by less than `most_growth` [1/s], as far as a trial of the length that this takes, or
  /// of the longest one allowed, can tell.
  bool stable(double h, double most_growth);

  /// [1/s] of the last trial: the logarithm of its growth over its second half's time.
  double growth() const { return growth_; }
  /// Whether that stood out from the ups and downs of what does not grow.
  bool resolved() const { return resolved_; }

 private:
  double energy(const State& state);
  void remember(const State& state, double size);

  const LinearisedStep& step_;
  Forces forces_;
  Step run_;
  double omega_ = 0.0, growth_ = 0.0;
  bool resolved_ = false;
  Eigen::MatrixX3d noise_, product_;
  State start_;
};

}  // namespace billow::sim
