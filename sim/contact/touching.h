// Who touches something at one moment, as far as its state alone can tell.
#pragma once

#include <Eigen/Core>

#include "sim/body/state.h"
#include "sim/contact/contact.h"

namespace billow::sim {

/// Of each particle at `state` (n): 1 where a face or an edge that it is a corner of, or itself, has its nearest point
/// to another surface, or to a far part of its own, within one and a half times the thickness that contact keeps there,
/// and the particle has a share in that point; else 0. Resting surfaces are one thickness apart.
Eigen::VectorXd touching(const ContactModel& model, const State& state);

}  // namespace billow::sim
