// The peak of the fastest mode, and k0 with that place held.
#include "sim/limit/step_setter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/linear/max_eigenvalue.h"

namespace billow::sim {

namespace {

constexpr double least_ratio = 2.0;  // worth naming

// Rough: a share of a step's length is meant.
constexpr EigenvalueOptions rough{.max_iterations = 200, .tolerance = 1e-2};

/// Sum of k over m of every free particle [1/s^2]; 0 of pinned ones.
Eigen::VectorXd local_stiffness(const Structure& structure) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(structure.particles());
  for (int s = 0; s < structure.springs(); ++s)
    for (int end = 0; end < 2; ++end) sum(structure.spring(s, end)) += structure.stiffness(s);
  return sum.cwiseProduct(structure.inverse_mass);
}

double median_of_positive(const Eigen::VectorXd& values) {
  std::vector<double> positive;
  for (const double value : values)
    if (value > 0.0) positive.push_back(value);
  if (positive.empty()) return 0.0;
  const auto middle = positive.begin() + static_cast<std::ptrdiff_t>(positive.size() / 2);
  std::nth_element(positive.begin(), middle, positive.end());
  return *middle;
}

int other_end(const Structure& structure, int spring, int particle) {
  const int first = structure.spring(spring, 0);
  return first == particle ? structure.spring(spring, 1) : first;
}

std::vector<int> springs_of(const Structure& structure, int particle) {
  std::vector<int> springs;
  for (int s = 0; s < structure.springs(); ++s)
    if (structure.spring(s, 0) == particle || structure.spring(s, 1) == particle) springs.push_back(s);
  return springs;
}

// k0 with a particle and those at its springs held.
double without(const Structure& structure, const StiffnessMatrix& stiffness, int particle,
               const std::vector<int>& springs) {
  Structure held = structure;
  held.inverse_mass(particle) = 0.0;
  for (const int s : springs) held.inverse_mass(other_end(structure, s, particle)) = 0.0;
  return max_eigenvalue(held, stiffness, rough).value;
}

}  // namespace

std::optional<StepSetter> find_step_setter(const Structure& structure, const StiffnessMatrix& stiffness) {
  const Eigen::VectorXd local = local_stiffness(structure);
  const double most = local.size() ? local.maxCoeff() : 0.0;
  if (!(most > least_ratio * least_ratio * median_of_positive(local))) return std::nullopt;
  Eigen::MatrixX3d mode;
  const double k0 = max_eigenvalue(structure, stiffness, rough, &mode).value;
  if (!std::isfinite(k0) || !mode.allFinite()) return std::nullopt;
  StepSetter setter;
  mode.rowwise().squaredNorm().maxCoeff(&setter.particle);
  const std::vector<int> springs = springs_of(structure, setter.particle);
  if (springs.empty()) return std::nullopt;
  setter.ratio = std::sqrt(k0 / std::max(without(structure, stiffness, setter.particle, springs), 1e-12 * k0));
  if (!(setter.ratio >= least_ratio)) return std::nullopt;
  const int shortest = *std::min_element(springs.begin(), springs.end(), [&](int a, int b) {
    return structure.rest_length(a) < structure.rest_length(b);
  });
  setter.neighbour = other_end(structure, shortest, setter.particle);
  setter.length = structure.rest_length(shortest);
  setter.mass = structure.mass(setter.particle);
  setter.median_mass = median_of_positive(free_mass(structure));
  return setter;
}

std::string text_of(const Structure& structure, const StepSetter& setter) {
  const Body& body = body_of(structure, setter.particle);
  return fmt::format(
      "edge {}-{} of '{}', {:.3g} mm long, sets the step: without its neighbourhood it would be {} times longer "
      "(particle {} has {:.3g} g, the median is {:.3g} g); merge such vertices in the mesh, use 'mass_distribution: "
      "uniform' or a filter",
      std::min(setter.particle, setter.neighbour) - body.first_particle,
      std::max(setter.particle, setter.neighbour) - body.first_particle, body.name, 1e3 * setter.length,
      fmt::format("{:.{}f}", setter.ratio, setter.ratio < 10.0 ? 1 : 0), setter.particle - body.first_particle,
      1e3 * setter.mass, 1e3 * setter.median_mass);
}

}  // namespace billow::sim
