// What a step limit is a limit of.
#pragma once

#include "sim/body/structure.h"
#include "sim/filter/filter.h"
#include "sim/linear/stiffness.h"
#include "sim/step/schemes.h"

namespace billow::sim {

/// The linearised step x, v -> scheme(force = -K x - C v, filter) of a run that lasts `duration`. What it refers to
/// must outlive it.
struct LinearisedStep {
  const Structure& structure;
  const Linearisation& linearisation;  // K and C, without negative eigenvalues
  const Eigen::MatrixX3d& position;    // (n x 3) [m] where the filter takes distances and rigid motions
  Method method;
  IntegratorOptions options = {};
  const Filter* filter = nullptr;  // may be null
  double duration = 10.0;          // [s] growth that comes to nothing in it is none
  // C never less than this, where `linearisation` is a bound; null where it is K and C themselves.
  const StiffnessMatrix* least_damping = nullptr;
};

/// What was found of the largest h for which a linearised step does not grow.
struct CertifiedStep {
  double step = 0.0;          // [s] 0 when even the smallest steps tried grow
  bool unlimited = false;     // stable at every step; `step` is then 0, or the largest one tried
  bool exact = false;         // by eigenvalues, as accurate as these; otherwise by trials
  int trials = 0;             // eigenvalues found, or trials run
  bool always_grows = false;  // at every step alike, if slowly: the filter's doing, which no step mends
};

}  // namespace billow::sim
