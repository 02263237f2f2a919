// The springs of a structure laid out for the vector passes: derived once, then read in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/aligned.h"
#include "sim/body/structure.h"
#include "sim/pass/band_groups.h"

namespace billow::sim {

/// Springs of a body numbered row by row, such as a grid's: every spring joins i and i + stride for one of a few
/// strides, and those of one stride are of one material. The rest length of particle i's spring of stride k is
/// rest_length[group[i / 16].begin + 16 k + i % 16], 0 where there is none.
///
///     a grid of 5 columns, edges and diagonals: stride = 1 4 5 6
///
///                          particles  0 ... 15     16 ... 31     group g begins at group[g].begin; equal groups, as
///     spring to i + 1            [16 lengths] [16 lengths]       most inside a grid are, share one place. One
///               i + 4            [16 lengths] [16 lengths]       stiffness and one damping a row.
///               i + 5            [16 lengths] [16 lengths]
///               i + 6            [16 lengths] [16 lengths]
struct SpringBands {
  int body = 0;  // of the structure
  int first_particle = 0, particles = 0;
  bool damped = false;
  DampingModel damping_model = DampingModel::projected;
  std::vector<int> stride;                 //         ascending, > 0
  std::vector<double> stiffness, damping;  // [N/m], [N s/m] of each stride
  AlignedVector<double> rest_length;       // [m]
  std::vector<BandGroup> group;            //         a row for each stride
};

/// Springs of any other body. Particles are taken four at a time, a slice, as they stand in `order`; each owns half of
/// its springs, so that the four of a slice own about equally many. Places are numbers in that order. A sweep keeps the
/// particles around the slice that it has come to in a ring: place p is row p % ring.
///
///     order      7  2  9  4 | 5  0 ...        slice 0 is the particles 7 2 9 4, at places 0 1 2 3
///     quads      7a 2a 9a 4a  7b 2b 9b .      their first springs side by side, then their second ones; a particle
///                                             that owns fewer has springs of rest length 0 to itself
///     begin      0            2 (slice 1)     slice t owns quads begin[t] ... begin[t + 1] - 1
///     ring       ... [row of slice t - reach] ... [row of slice t] ... [row of slice t + reach] ...
struct SpringSlices {
  int body = 0;  // of the structure
  int first_particle = 0, particles = 0;
  bool damped = false;
  DampingModel damping_model = DampingModel::projected;
  int slices = 0;
  int ring = 0;                       //         rows, a power of two
  int reach = 0;                      //         slices: no spring ends farther from the slice that owns it
  std::vector<int> order;             //         the body's particles as the slices take them
  std::vector<int> begin;             //         quads of each slice; one at least
  std::vector<std::uint32_t> other;   //         where in the ring, in doubles, the end is that is not the owner;
                                      //         one more quad
  AlignedVector<double> rest_length;  // [m]     0 where a particle owns fewer springs than others of its slice
  AlignedVector<double> stiffness;    // [N/m]
  AlignedVector<double> damping;      // [N s/m]
};

/// Particles of a slice.
constexpr int slice_lanes = 4;

/// Doubles of a row of the ring: position, sum and, where springs damp, velocity; a power of two.
constexpr std::size_t slice_row(bool damped) { return damped ? 16 : 8; }

/// Each body of linear springs as bands or as slices; bodies of another model and of none are left to the plain pass.
struct SpringPlan {
  explicit SpringPlan(const Structure& structure);

  std::vector<SpringBands> bands;
  std::vector<SpringSlices> slices;
  std::vector<int> others;  // bodies that are neither
};

}  // namespace billow::sim
