// How much of a field a filter lets pass.
#pragma once

#include <Eigen/Core>

#include "sim/body/structure.h"
#include "sim/filter/filter.h"

namespace billow::sim {

/// <v, F v> and <v, v> of a field (n x 3) in the free particles' masses' inner product; F at `position` and `time`.
struct FilteredShare {
  double passed = 0.0, whole = 0.0;
  /// 1 where there is nothing to filter.
  double response() const { return whole > 0.0 ? passed / whole : 1.0; }
};
FilteredShare filtered_share(const Structure& structure, const Filter& filter, const Eigen::MatrixX3d& position,
                             double time, const Eigen::MatrixX3d& field, FilterScratch& scratch);

/// A standing wave's undamped frequency [1/s], (v . L v / v . M v)^1/2 / 2 pi with L that of the stiffest shape, and a
/// filter's response to it.
struct WaveResponse {
  double frequency = 0.0, response = 1.0;
};

/// The von Neumann picture of `filter`, at rest: for `count` >= 2 waves cos(k s) of `body`, s along the longest of its
/// rest positions' extents from its end, k evenly spaced in its logarithm from one half wave in the body to two mean
/// rest lengths a wave. Ascending in k. Null: no filter, all responses are 1.
std::vector<WaveResponse> wave_responses(const Structure& structure, const Body& body, const Filter* filter, int count);

}  // namespace billow::sim
