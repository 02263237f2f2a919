// Closed mesh -> Structure: a cloth, braced.
#include "sim/body/soft_body.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sim/body/interior_springs.h"
#include "sim/body/needed_springs.h"
#include "sim/body/solid_springs.h"
#include "sim/mesh/closed_surface.h"

namespace billow::sim {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

// `pairs` ascend.
Pairs without_springs_of(const Structure& body, const Pairs& pairs) {
  Pairs taken, rest;
  for (int s = 0; s < body.springs(); ++s) taken.emplace_back(body.spring(s, 0), body.spring(s, 1));
  std::sort(taken.begin(), taken.end());
  std::set_difference(pairs.begin(), pairs.end(), taken.begin(), taken.end(), std::back_inserter(rest));
  return rest;
}

void add_interior(const Pairs& pairs, const SoftBodyOptions& options, Structure& body) {
  const Eigen::Index first = body.springs(), m = first + static_cast<Eigen::Index>(pairs.size());
  body.spring.conservativeResize(m, 2);
  body.rest_length.conservativeResize(m);
  body.stiffness.conservativeResize(m);
  body.damping.conservativeResize(m);
  for (Eigen::Index s = first; s < m; ++s) {
    const auto& [i, j] = pairs[static_cast<std::size_t>(s - first)];
    body.spring.row(s) << i, j;
    body.rest_length(s) = (body.rest_position.row(j) - body.rest_position.row(i)).norm();
    body.stiffness(s) = options.interior;
    body.damping(s) = options.surface.damping;
    body.kind.push_back(SpringKind::interior);
  }
  body.body.front().springs = body.springs();
}

void vary_stiffness(const Eigen::VectorXd& factor, Structure& body) {
  if (factor.size() == 0) return;
  for (int s = 0; s < body.springs(); ++s)
    body.stiffness(s) *= 0.5 * (factor(body.spring(s, 0)) + factor(body.spring(s, 1)));
}

// The body keeps its weight: only the proportions change.
void vary_mass(const Eigen::VectorXd& factor, Structure& body) {
  if (factor.size() == 0) return;
  const double whole = body.mass.sum();
  body.mass.array() *= factor.array();
  body.mass *= whole / body.mass.sum();
  for (int i = 0; i < body.particles(); ++i)
    if (!body.pinned(i)) body.inverse_mass(i) = 1.0 / body.mass(i);
}

}  // namespace

Structure build_soft_body(const Mesh& mesh, const SoftBodyOptions& options) {
  require_solid(mesh);
  Structure body = build_cloth(mesh, options.surface);
  add_interior(without_springs_of(body, interior_pairs(mesh)), options, body);
  if (options.young) {
    body.stiffness = solid_stiffness(mesh, body, *options.young);
    body = with_needed_springs(std::move(body));
  }
  vary_stiffness(options.stiffness_factor, body);
  vary_mass(options.mass_factor, body);
  return body;
}

}  // namespace billow::sim
