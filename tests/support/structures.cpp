// Chains, grids, rings and oscillators.
#include "tests/support/structures.h"

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace billow::test {

namespace {

struct SpringSpec {
  int i, j;
  double stiffness;
  sim::SpringKind kind;
};

sim::Structure assembled(const Eigen::MatrixX3d& position, double mass, const std::vector<int>& pinned,
                         const std::vector<SpringSpec>& springs) {
  sim::Structure s;
  const int n = static_cast<int>(position.rows()), m = static_cast<int>(springs.size());
  s.rest_position = position;
  s.mass = Eigen::VectorXd::Constant(n, mass);
  s.inverse_mass = s.mass.cwiseInverse();
  for (const int i : pinned) s.inverse_mass(i) = 0.0;
  s.spring.resize(m, 2);
  s.rest_length.resize(m);
  s.stiffness.resize(m);
  s.damping = Eigen::VectorXd::Zero(m);
  for (int k = 0; k < m; ++k) {
    s.spring.row(k) << springs[k].i, springs[k].j;
    s.rest_length(k) = (position.row(springs[k].i) - position.row(springs[k].j)).norm();
    s.stiffness(k) = springs[k].stiffness;
    s.kind.push_back(springs[k].kind);
  }
  sim::Body body;
  body.name = "body";
  body.particles = n;
  body.springs = m;
  double sum = 0.0;
  int count = 0;
  for (int k = 0; k < m; ++k)
    if (s.kind[k] == sim::SpringKind::structural) sum += s.rest_length(k), ++count;
  body.mean_rest_length = sum / count;
  s.body = {body};
  return s;
}

}  // namespace

sim::Structure fixed_chain(const ChainOptions& o) {
  const int n = o.free_particles + 1 + (o.second_wall ? 1 : 0);
  Eigen::MatrixX3d position = Eigen::MatrixX3d::Zero(n, 3);
  for (int i = 0; i < n; ++i) position(i, 0) = i * o.rest_length;
  std::vector<SpringSpec> springs;
  for (int i = 0; i + 1 < n; ++i) springs.push_back({i, i + 1, o.stiffness, sim::SpringKind::structural});
  std::vector<int> pinned{0};
  if (o.second_wall) pinned.push_back(n - 1);
  return assembled(position, o.mass, pinned, springs);
}

sim::Structure light_cloth(int width, int height, std::vector<int> pinned) {
  return grid({.width = width,
               .height = height,
               .spacing = 0.1,
               .mass = 0.01,
               .structural = 100.0,
               .shear = 70.0,
               .bend = 30.0,
               .pinned = std::move(pinned)});
}

sim::Structure oscillator(double mass, double stiffness, double rest_length) {
  return fixed_chain(
      {.free_particles = 1, .mass = mass, .stiffness = stiffness, .rest_length = rest_length, .second_wall = false});
}

sim::Structure grid(const GridOptions& o) {
  Eigen::MatrixX3d position(o.width * o.height, 3);
  std::vector<SpringSpec> springs;
  const auto at = [&](int x, int z) { return x + o.width * z; };
  const auto link = [&](int x, int z, int dx, int dz, double stiffness, sim::SpringKind kind) {
    const int x1 = x + dx, z1 = z + dz;
    if (x1 < 0 || x1 >= o.width || z1 >= o.height) return;
    springs.push_back({at(x, z), at(x1, z1), stiffness, kind});
  };
  for (int z = 0; z < o.height; ++z)
    for (int x = 0; x < o.width; ++x) {
      position.row(at(x, z)) << x * o.spacing, 0.0, z * o.spacing;
      for (const auto& [dx, dz] : {std::pair{1, 0}, std::pair{0, 1}})
        link(x, z, dx, dz, o.structural, sim::SpringKind::structural);
      for (const auto& [dx, dz] : {std::pair{1, 1}, std::pair{-1, 1}})
        link(x, z, dx, dz, o.shear, sim::SpringKind::shear);
      for (const auto& [dx, dz] : {std::pair{2, 0}, std::pair{0, 2}}) link(x, z, dx, dz, o.bend, sim::SpringKind::bend);
    }
  return assembled(position, o.mass, o.pinned, springs);
}

sim::Structure ring(int particles, double mass, double stiffness, double rest_length) {
  const double angle = 2.0 * std::numbers::pi / particles, radius = 0.5 * rest_length / std::sin(0.5 * angle);
  Eigen::MatrixX3d position(particles, 3);
  std::vector<SpringSpec> springs;
  for (int i = 0; i < particles; ++i) {
    position.row(i) << radius * std::cos(i * angle), 0.0, radius * std::sin(i * angle);
    const int next = (i + 1) % particles;
    springs.push_back({std::min(i, next), std::max(i, next), stiffness, sim::SpringKind::structural});
  }
  return assembled(position, mass, {}, springs);
}

sim::Structure with_uneven_masses(sim::Structure structure, double spread, std::uint64_t seed) {
  structure.mass.array() *= 1.0 + spread * seeded_noise(structure.particles(), seed).col(0).array();
  structure.inverse_mass = structure.inverse_mass.cwiseSign().cwiseQuotient(structure.mass);
  return structure;
}

sim::State shaken_state(const sim::Structure& structure, double distance, double speed, std::uint64_t seed) {
  const Eigen::VectorXd free = structure.inverse_mass.cwiseSign();
  sim::State state = sim::rest_state(structure);
  state.position += distance * free.asDiagonal() * seeded_noise(structure.particles(), seed);
  state.velocity = speed * free.asDiagonal() * seeded_noise(structure.particles(), seed + 1);
  return state;
}

}  // namespace billow::test
