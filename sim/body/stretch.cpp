// A pass over structural springs.
#include "sim/body/stretch.h"

#include <algorithm>
#include <cmath>

namespace billow::sim {

namespace {

// (l - L)/L of a spring.
double stretch_of_spring(const Structure& structure, const State& state, int s) {
  const int i = structure.spring(s, 0), j = structure.spring(s, 1);
  return (state.position.row(j) - state.position.row(i)).norm() / structure.rest_length(s) - 1.0;
}

}  // namespace

Stretch stretch_of(const Structure& structure, const State& state) {
  double largest = -INFINITY, sum = 0.0;
  int count = 0;
  for (int s = 0; s < structure.springs(); ++s) {
    if (structure.kind[s] != SpringKind::structural) continue;
    const double stretch = stretch_of_spring(structure, state, s);
    largest = std::max(largest, stretch);
    sum += stretch;
    ++count;
  }
  return count > 0 ? Stretch{largest, sum / count} : Stretch{};
}

Eigen::VectorXd strain_of(const Structure& structure, const State& state) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(structure.particles()), count = sum;
  for (int s = 0; s < structure.springs(); ++s) {
    if (structure.kind[s] != SpringKind::structural) continue;
    const double strain = std::abs(stretch_of_spring(structure, state, s));
    for (const int end : {structure.spring(s, 0), structure.spring(s, 1)}) sum(end) += strain, count(end) += 1.0;
  }
  return sum.cwiseQuotient(count.cwiseMax(1.0));
}

}  // namespace billow::sim
