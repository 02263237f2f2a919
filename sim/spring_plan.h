// The springs of a structure laid out for the vector passes: derived once, then read in order.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/aligned.h"
#include "sim/structure.h"

namespace billow::sim {

/// Particles are taken in groups of this many, whatever the processor's vectors hold: 2, 4 or 8 doubles.
constexpr int band_group = 16;

/// Springs of a body numbered row by row, such as a grid's: every spring joins i and i + stride for one of a few
/// strides, and those of one stride are of one material. Spring k of particle i is at
/// [(i / 16 * strides + k) * 16 + i % 16]; where there is none, its rest length is 0.
struct SpringBands {
  int body = 0;  // of the structure
  int first_particle = 0, particles = 0;
  bool damped = false;
  DampingModel damping_model = DampingModel::projected;
  std::vector<int> stride;                 //         ascending, > 0
  std::vector<double> stiffness, damping;  // [N/m], [N s/m] of each stride
  AlignedVector<double> rest_length;       // [m]
};

/// Springs of any other body, sorted by their first end and taken four at a time; particles are taken four at a time
/// too, a slice. A slice adds the forces of the springs that start in it and subtracts those of the springs that end in
/// it, both being numbered by their place in `order`. Springs' forces wait for that in a ring, each at its number
/// modulo the ring's size.
struct SpringSlices {
  int body = 0;  // of the structure
  int first_particle = 0, particles = 0;
  bool damped = false;
  DampingModel damping_model = DampingModel::projected;
  std::vector<int> order;                 //         the body's particles as the slices take them; empty: as they are
  std::vector<int> first, second;         //         ends, as places in that order; padded to whole quads
  AlignedVector<double> rest_length;      // [m]
  AlignedVector<double> stiffness;        // [N/m]   0 in the padding
  AlignedVector<double> damping;          // [N s/m]
  int ring = 0;                           //         springs in the ring, a power of two; slot `ring` stays zero
  std::vector<int> slice_quads;           //         quads that must have been done before slice t can be summed
  std::vector<int> entry_begin;           //         slice t's places in the ring: entry[entry_begin[t]] ...
  std::vector<int> plus;                  //         of which this many, times four, are added, the rest subtracted
  std::vector<std::uint32_t> entry;       //         offset in the ring, in doubles; four particles side by side
  struct Block {                          //         a run of slices small enough for the cache
    int first_slice = 0, last_slice = 0;  //         [first, last)
    int first_quad = 0;                   //         the earliest that it needs
    int low = 0, high = 0;                //         [low, high) particles that its springs touch
  };
  std::vector<Block> block;
};

/// Slices whose springs are computed ahead of the one that is being summed.
constexpr int slice_lead = 2;

/// Each body of linear springs as bands or as slices; bodies of another model and of none are left to the plain pass.
struct SpringPlan {
  explicit SpringPlan(const Structure& structure);

  std::vector<SpringBands> bands;
  std::vector<SpringSlices> slices;
  std::vector<int> others;  // bodies that are neither
};

}  // namespace billow::sim
