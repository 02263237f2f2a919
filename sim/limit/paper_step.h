// The paper's equation 11.
#pragma once

#include <optional>

#include "sim/step/schemes.h"

namespace billow::sim {

/// The paper's step limit [s] for a scheme, omega h of its row over sqrt(eigenvalue) (equation 11); none for implicit
/// schemes or a structure without stiffness.
std::optional<double> paper_step(Method method, double eigenvalue);

}  // namespace billow::sim
