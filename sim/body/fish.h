// The fish of Tu & Terzopoulos 1994 as a structure: 23 particles and 91 viscoelastic units, built by name.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "sim/body/structure.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

/// Along the body: the snout, five rings of four particles, and the two tips of the tail fin.
inline constexpr int fish_rings = 5;
inline constexpr int fish_particles = 1 + 4 * fish_rings + 2;
/// Muscles run between the first four rings: three segments of two left/right pairs.
inline constexpr int fish_segments = 3;

enum class Side { left, right };
enum class Level { dorsal, ventral };

/// Particle numbers within the body.
int fish_snout();
int fish_node(int ring, Side side, Level level);  // ring from 0, behind the snout, to fish_rings - 1
int fish_tail_tip(Level level);

/// One of the units that can contract.
struct Muscle {
  int spring;   // within the body
  int segment;  // 0 is the one behind the head
  Side side;
};

/// Masses [kg] of each particle of a station along the body.
struct FishMass {
  double snout = 1.1;
  std::array<double, fish_rings> ring{6.6, 11.0, 6.6, 1.1, 1.1};
  double tail_tip = 0.165;
};

/// A fish and where it starts. The defaults are the numbers of method.md section 1, and hold for default_fish_length.
struct FishOptions {
  std::string name = "fish";
  double length = 1.8;  // [m] from the tip of the snout's skin to the end of the tail fin's
  FishMass mass;
  double cross = 38.0;     // [N/m] diagonals: they keep the body's shape, so they are the stiffest
  double normal = 30.0;    // [N/m] snout, rings, tail
  double muscle = 28.0;    // [N/m]
  double viscosity = 0.1;  // [N s/m] of every unit
  double friction = 0.0;   // [kg/s]  of every particle
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // body axes -> world
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      // [m] of the middle of the length
};

inline constexpr double default_fish_length = 1.8;  // [m]

/// The defaults for a fish of another length, of the same flesh: with s = length / default_fish_length masses go with
/// s^3, stiffness with s and viscosity with s^2. It then moves exactly like the default fish, at a pace 1/s.
FishOptions fish_of_length(double length);

/// The fish at rest. In body axes it looks along +x with its back to +y, so its right side is +z. Springs are listed
/// from head to tail. Throws InputError when a particle would have no mass.
Structure build_fish(const FishOptions& options);

/// The twelve muscles, from head to tail.
std::vector<Muscle> fish_muscles();

/// The closed skin between the particles: 24 triangles and quads, counter-clockwise seen from outside, mirror images of
/// each other left and right.
std::vector<Face> fish_faces();

/// Distance behind the tip of the snout, as a share of the length, of every station: snout, rings, tail tips.
std::array<double, fish_rings + 2> fish_stations();

}  // namespace billow::sim
