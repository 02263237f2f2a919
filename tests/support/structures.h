// Small structures with known answers.
#pragma once

#include <cstdint>

#include "sim/body/state.h"
#include "sim/body/structure.h"

namespace billow::test {

/// n equal masses between two walls, springs in a row along x at their rest length.
struct ChainOptions {
  int free_particles = 10;
  double mass = 1.0;         // [kg]
  double stiffness = 1.0;    // [N/m]
  double rest_length = 1.0;  // [m]
  bool second_wall = true;   // else the chain ends free
};
sim::Structure fixed_chain(const ChainOptions& options);

/// w x h particles in the xz-plane with structural, shear and stride-2 bend springs; particle x + w z.
struct GridOptions {
  int width = 10, height = 10;
  double spacing = 1.0;  // [m]
  double mass = 1.0;     // [kg] per particle
  double structural = 1.0, shear = 0.7, bend = 0.3;
  std::vector<int> pinned = {};
};
sim::Structure grid(const GridOptions& options);

/// A grid of light cloth: particles of 10 g every 0.1 m, springs of 100, 70 and 30 N/m.
sim::Structure light_cloth(int width, int height, std::vector<int> pinned = {});

/// Two particles, one spring along x: the first pinned, the second free.
sim::Structure oscillator(double mass, double stiffness, double rest_length = 1.0);

/// n free particles evenly on a circle in the xz-plane, each joined to the next.
sim::Structure ring(int particles, double mass, double stiffness, double rest_length = 1.0);

/// The structure with particle masses spread evenly over [1 - spread, 1 + spread] times their own.
sim::Structure with_uneven_masses(sim::Structure structure, double spread, std::uint64_t seed = 7);

/// The structure with every particle moved by up to `distance` [m] and given up to `speed` [m/s] along each axis;
/// pinned particles stay at rest.
sim::State shaken_state(const sim::Structure& structure, double distance, double speed, std::uint64_t seed = 1);

}  // namespace billow::test
