// Copies that differ in their last digits -> one value.
#include "sim/mesh/regular_values.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace billow::sim {

namespace {

constexpr std::size_t most = 64;
constexpr double tolerance = 1e-4;

struct Copies {
  double low, high;
  double middle() const { return low + 0.5 * (high - low); }
};

bool alike(double low, double high) { return high <= low * (1.0 + tolerance); }

// The copies that `value` is or may be one of: the first that do not end well before it.
std::vector<Copies>::iterator place_of(std::vector<Copies>& found, double value) {
  return std::partition_point(found.begin(), found.end(),
                              [value](const Copies& copies) { return !alike(copies.high, value); });
}

// Empty: they are not a few.
std::vector<Copies> different_values(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::vector<Copies> found;
  for (const double value : values) {
    const auto at = place_of(found, value);
    if (at == found.end() || !alike(value, at->low)) {
      if (found.size() == most) return {};
      found.insert(at, {value, value});
    } else {
      at->low = std::min(at->low, value), at->high = std::max(at->high, value);
    }
  }
  const auto run_together = [](const Copies& a, const Copies& b) { return alike(a.high, b.low); };
  const bool wide = std::any_of(found.begin(), found.end(), [](const Copies& c) { return !alike(c.low, c.high); });
  const bool clear = std::adjacent_find(found.begin(), found.end(), run_together) == found.end();
  return wide || !clear ? std::vector<Copies>{} : found;
}

}  // namespace

void make_regular(Eigen::Ref<Eigen::VectorXd> values) {
  std::vector<Copies> found = different_values(values);
  if (found.empty()) return;
  for (double& value : values) value = place_of(found, value)->middle();
}

}  // namespace billow::sim
