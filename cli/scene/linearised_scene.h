// What a certificate has to know of a scene.
#pragma once

#include "cli/scene/scene.h"
#include "sim/limit/linearised_step.h"

namespace billow::cli {

/// The scene's own step, linearised as `linearisation` says, at rest distances. Everything given must outlive it;
/// `filter` and `least_damping` may be null.
inline sim::LinearisedStep linearised_step(const Scene& scene, const sim::Structure& structure,
                                           const sim::Linearisation& linearisation, const sim::Filter* filter,
                                           const sim::StiffnessMatrix* least_damping) {
  return {.structure = structure,
          .linearisation = linearisation,
          .position = structure.rest_position,
          .method = scene.solver.method,
          .options = scene.solver.integrator,
          .filter = filter,
          .duration = scene.duration,
          .least_damping = least_damping};
}

}  // namespace billow::cli
