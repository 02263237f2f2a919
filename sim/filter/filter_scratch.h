// The memory that a filter works in.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/aligned.h"
#include "sim/filter/body_motion.h"
#include "sim/pass/filter_plan.h"
#include "sim/pass/pass_scratch.h"

namespace billow::sim {

/// A filter's weights by particle and by neighbour.
struct FilterWeights {
  Eigen::VectorXd self;       // (n)
  Eigen::VectorXd neighbour;  // one per entry of the neighbours' rows
};

/// Belongs to whoever filters and is used again: two that filter at the same time need two.
struct FilterScratch {
  PassScratch pass;
  Eigen::MatrixX3d filtered;                 // (n x 3) what a field becomes, before it changes places with it
  FilterWeights weights;                     // of the moment, where they change
  PlacedWeights placed;                      // the same in the plan's order
  std::vector<AlignedVector<double>> level;  // the particles' rows and those of each level's nodes
  std::vector<BodyMotion> before;            // of every body, where its momenta are to be restored
};

}  // namespace billow::sim
