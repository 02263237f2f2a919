// The filter's weights laid out for the vector pass: derived from its neighbours once.
#pragma once

#include <cstddef>
#include <vector>

#include "base/aligned.h"
#include "sim/body/structure.h"
#include "sim/pass/band_groups.h"

namespace billow::sim {

/// Who is whose neighbour, in compressed rows: particle i's are column[first[i]] ... column[first[i + 1] - 1].
struct NeighbourRows {
  std::vector<int> first, column;
};

/// Weights in the order in which a pass reads them.
struct PlacedWeights {
  AlignedVector<double> value;
  std::vector<BandGroup> group;  // of all bands; a row for each offset
};

/// A body whose neighbours lie at a few constant distances: weight k of particle i, that of particle i + offset[k], is
/// value[group[first_group + i / 16].begin + 16 k + i % 16]; 0 where there is no such neighbour.
///
///     a grid of 5 columns, springs to the right and down: offset = -5 -1 0 1 5
///
///                   particles  0 ... 15     16 ... 31      group g begins at group[first_group + g].begin;
///     weight of i - 5       [16 numbers] [16 numbers]      equal groups, as most inside a grid are, share one place
///               i - 1       [16 numbers] [16 numbers]
///               i           [16 numbers] [16 numbers]
///               i + 1       [16 numbers] [16 numbers]
///               i + 5       [16 numbers] [16 numbers]
struct FilterBands {
  int first_particle = 0, particles = 0;
  std::vector<int> offset;  // ascending; 0, the particle itself, is one
  std::size_t first_group = 0;
};

/// Any other body, four particles at a time: weights and neighbours of the four side by side. Rows of a slice that are
/// shorter than its longest are filled up with weights of 0.
///
///     place    0  1  2  3    4  5  6  7    8  9 10 11   12 13 14 15
///              a  b  c  d    a1 b1 c1 d1   a2 b2 .  d2   a3 .  .  .      slice 0: itself, then its neighbours
///              slice_begin[0] = 0 ...                    slice_begin[1] = 4 (quads)
struct FilterSlices {
  static constexpr int lanes = 4;
  static constexpr int block_slices = 512, block_particles = lanes * block_slices;

  int first_particle = 0, particles = 0;
  std::vector<int> slice_begin;  // slice t's are places begin + 4 slice_begin[t] ... begin + 4 slice_begin[t + 1] - 1
  std::vector<int> order;        // the body's particles as the slices take them; empty: as they are
  std::vector<int> column;       // of each place, as a place in that order
  std::size_t begin = 0;
  struct Block {
    int first_slice = 0, last_slice = 0;  // [first, last)
    int low = 0, high = 0;                // [low, high) particles that they read
  };
  std::vector<Block> block;  // of block_slices slices, the last perhaps fewer
};

/// Where each weight of the compressed rows goes.
class FilterPlan {
 public:
  FilterPlan() = default;
  FilterPlan(const Structure& structure, const NeighbourRows& neighbours);

  /// self (n) and neighbour (one per entry of the rows) -> the weights in the plan's order, `placed`'s memory used
  /// again.
  void place(const Eigen::VectorXd& self, const Eigen::VectorXd& neighbour, PlacedWeights& placed) const;
  /// Those of equal groups of the bands in one place.
  void share_equal_groups(PlacedWeights& weights) const;

  std::vector<FilterBands> bands;
  std::vector<FilterSlices> slices;

 private:
  void add_bands(const Body& body, const NeighbourRows& neighbours, const std::vector<int>& stride);
  void add_slices(const Body& body, const NeighbourRows& neighbours, std::vector<int> order);
  void append_slice(const NeighbourRows& neighbours, const std::vector<int>& rank, int slice, FilterSlices& slices);

  std::size_t places_ = 0;
  std::vector<std::size_t> self_place_, neighbour_place_;
  std::vector<BandGroup> group_;  // of every band, with places for all of them
};

}  // namespace billow::sim
