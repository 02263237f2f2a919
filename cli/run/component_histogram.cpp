// Bins on a logarithmic scale. Their borders are found by exact operations, so that no processor counts otherwise.
#include "cli/run/component_histogram.h"

#include <algorithm>
#include <cmath>

namespace billow::cli {

// Within an octave bins are evenly wide: size = mantissa 2^exponent, mantissa in [1/2, 1).
int ComponentHistogram::bin_of(double size) {
  int exponent = 0;
  const double mantissa = std::frexp(size, &exponent);
  const int within = static_cast<int>((mantissa - 0.5) * 2.0 * per_octave);
  return std::clamp((exponent - first_octave) * per_octave + within, 0, per_octave * octaves - 1);
}

void ComponentHistogram::add(const Eigen::MatrixX3d& velocity) {
  constexpr double at_rest = 1e-9;  // [m/s]
  for (const double component : velocity.reshaped()) {
    const double size = std::abs(component);
    if (!(size > at_rest) || !std::isfinite(size)) continue;
    ++count_[static_cast<std::size_t>(bin_of(size))];
    ++total_;
  }
}

double ComponentHistogram::percentile(double share) const {
  if (total_ == 0) return 0.0;
  const double wanted = share * static_cast<double>(total_);
  long sum = 0;
  int bin = 0;
  while (static_cast<double>(sum += count_[static_cast<std::size_t>(bin)]) < wanted) ++bin;
  const double upper = 0.5 + 0.5 * (bin % per_octave + 1) / per_octave;
  return std::ldexp(upper, bin / per_octave + first_octave);
}

}  // namespace billow::cli
