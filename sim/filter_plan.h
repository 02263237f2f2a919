// The filter's weights laid out for the vector pass: derived from its neighbours once.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/aligned.h"
#include "sim/band_groups.h"
#include "sim/structure.h"

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
struct FilterBands {
  int first_particle = 0, particles = 0;
  std::vector<int> offset;  // ascending; 0, the particle itself, is one
  std::size_t first_group = 0;
};

/// Any other body, four particles at a time: weights and neighbours of the four side by side.
struct FilterSlices {
  int first_particle = 0, particles = 0;
  std::vector<int> slice_begin;  // slice t's are places begin + 4 slice_begin[t] ... begin + 4 slice_begin[t + 1] - 1
  std::vector<int> order;        // the body's particles as the slices take them; empty: as they are
  std::vector<int> column;       // of each place, as a place in that order
  std::size_t begin = 0;
  struct Block {
    int first_slice = 0, last_slice = 0;  // [first, last)
    int low = 0, high = 0;                // [low, high) particles that they read
  };
  std::vector<Block> block;
};

/// Where each weight of the compressed rows goes.
class FilterPlan {
 public:
  FilterPlan() = default;
  FilterPlan(const Structure& structure, const NeighbourRows& neighbours);

  /// self (n) and neighbour (one per entry of the rows) -> the weights in the plan's order.
  PlacedWeights place(const Eigen::VectorXd& self, const Eigen::VectorXd& neighbour) const;
  /// Those of equal groups of the bands in one place.
  void share_equal_groups(PlacedWeights& weights) const;

  std::vector<FilterBands> bands;
  std::vector<FilterSlices> slices;

 private:
  void add_bands(const Body& body, const NeighbourRows& neighbours, const std::vector<int>& stride);
  void add_slices(const Body& body, const NeighbourRows& neighbours, std::vector<int> order);

  std::size_t places_ = 0;
  std::vector<std::size_t> self_place_, neighbour_place_;
  std::vector<BandGroup> group_;  // of every band, with places for all of them
};

}  // namespace billow::sim
