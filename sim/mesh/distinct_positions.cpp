// Chains of a hash of cells twice the tolerance wide: whatever is within the tolerance of a point lies in the eight
// cells around the cell corner nearest to it, so copies that straddle a cell border are found too.
#include "sim/mesh/distinct_positions.h"

#include <algorithm>

namespace billow::sim {
namespace {

std::array<std::int64_t, 3> cell_of(const Eigen::Array3d& scaled) {
  const Eigen::Array3d corner = scaled.floor();
  return {static_cast<std::int64_t>(corner.x()), static_cast<std::int64_t>(corner.y()),
          static_cast<std::int64_t>(corner.z())};
}

}  // namespace

// A chain may hold positions of other cells too: what counts is the distance, which is always looked at.
std::size_t DistinctPositions::bucket_of(const Cell& cell) const {
  std::uint64_t hash = 0;
  for (const std::int64_t index : cell) {
    hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
  }
  return hash & (first_.size() - 1);  // a power of two
}

Eigen::Array3d DistinctPositions::scaled(const Eigen::Vector3d& point) const {
  return (point - origin_).array() / (2.0 * tolerance_);
}

// Most points are exact copies of a position, which then is the nearest: one cell is looked at instead of eight.
int DistinctPositions::find_equal(const Eigen::Vector3d& point) const {
  for (int number = first_[bucket_of(cell_of(scaled(point)))]; number >= 0; number = next_[number])
    if (positions_[number] == point) return number;
  return -1;
}

int DistinctPositions::find(const Eigen::Vector3d& point) const {
  if (positions_.empty()) return -1;
  if (const int equal = find_equal(point); equal >= 0) return equal;
  const Cell low = cell_of(scaled(point) - 0.5);
  int nearest = -1;
  double nearest_distance = tolerance_;
  for (int corner = 0; corner < 8; ++corner) {
    const Cell cell{low[0] + (corner & 1), low[1] + (corner >> 1 & 1), low[2] + (corner >> 2)};
    for (int number = first_[bucket_of(cell)]; number >= 0; number = next_[number]) {
      const double distance = (positions_[number] - point).norm();
      const bool tie = distance == nearest_distance && (nearest < 0 || number < nearest);
      if (distance < nearest_distance || tie) {
        nearest = number;
        nearest_distance = distance;
      }
    }
  }
  return nearest;
}

int DistinctPositions::find_or_add(const Eigen::Vector3d& point) {
  if (const int known = find(point); known >= 0) return known;
  const int number = static_cast<int>(positions_.size());
  positions_.push_back(point);
  next_.push_back(-1);
  if (positions_.size() > first_.size())
    make_room();
  else
    link(number);
  return number;
}

void DistinctPositions::link(int number) {
  int& first = first_[bucket_of(cell_of(scaled(positions_[number])))];
  next_[number] = first;
  first = number;
}

// Twice the buckets, so that a chain holds about one position.
void DistinctPositions::make_room() {
  first_.assign(std::max<std::size_t>(64, 2 * first_.size()), -1);
  for (int number = 0; number < static_cast<int>(positions_.size()); ++number) link(number);
}

}  // namespace billow::sim
