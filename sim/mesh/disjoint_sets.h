// What hangs together, found pair by pair.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace billow::sim {

/// Numbers from 0 in sets, at first each in its own. A set goes by its smallest number, so that it does not depend on
/// the order in which its members were joined.
class DisjointSets {
 public:
  explicit DisjointSets(int count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The smallest number of the set that `k` is in.
  int root(int k) {
    while (at(k) != k) k = at(k) = at(at(k));
    return k;
  }

  void join(int one, int other) {
    const int a = root(one), b = root(other);
    at(std::max(a, b)) = std::min(a, b);
  }

 private:
  int& at(int k) { return parent_[static_cast<std::size_t>(k)]; }

  std::vector<int> parent_;
};

}  // namespace billow::sim
