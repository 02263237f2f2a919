// When the second level is worth its while.
#include "sim/step/two_level.h"

#include <algorithm>
#include <utility>

namespace billow::sim {

namespace {

// The coarse matrices bring 132 iterations down to 24, but 10 only to 7, which does not pay for them. So they come in
// when a solve without them takes many iterations and go when one with them takes few.
constexpr long many_iterations = 24, few_iterations = 8;

// [step] The cloth turns away from under them: three times as old they cost half as many iterations again.
constexpr int most_age = 3;

// Dense solves with more nodes would take longer than the products that they save, and Eigen would cut their sums where
// the processor's caches end, from 256 rows on.
constexpr int most_nodes = 64, particles_per_node = 32;

}  // namespace

void TwoLevel::set(const StiffnessMatrix& matrix, long iterations) {
  blocks_.set(matrix);
  const bool used = used_;
  choose(iterations);
  if (!used_) return;
  if (!built_) build();
  if (used && ++age_ < most_age) return;
  for (CoarseCorrection& coarse : coarse_) coarse.set(matrix);
  age_ = 0;
}

void TwoLevel::choose(long iterations) { used_ = iterations > (used_ ? few_iterations : many_iterations); }

void TwoLevel::build() {
  built_ = true;
  for (const Body& body : structure_.body)
    if (auto level = build_coarse_level(structure_, body, std::min(most_nodes, body.particles / particles_per_node)))
      coarse_.emplace_back(structure_, body, std::move(*level));
}

void TwoLevel::apply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
  blocks_.apply(x, y);
  if (!used_) return;
  for (CoarseCorrection& coarse : coarse_) coarse.add(x, y);
}

}  // namespace billow::sim
