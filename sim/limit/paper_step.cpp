// A limit of omega h -> a step.
#include "sim/limit/paper_step.h"

#include <cmath>

namespace billow::sim {

std::optional<double> paper_step(Method method, double eigenvalue) {
  const std::optional<double> limit = scheme(method).omega_h;
  if (!limit || eigenvalue <= 0.0) return std::nullopt;
  return *limit / std::sqrt(eigenvalue);
}

}  // namespace billow::sim
