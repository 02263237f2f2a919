// A hash of cells twice the tolerance wide: whatever is within the tolerance of a point lies in the eight cells around
// the cell corner nearest to it, so copies that straddle a cell border are found too.
#include "sim/mesh/distinct_positions.h"

namespace billow::sim {
namespace {

std::array<std::int64_t, 3> cell_of(const Eigen::Array3d& scaled) {
  const Eigen::Array3d corner = scaled.floor();
  return {static_cast<std::int64_t>(corner.x()), static_cast<std::int64_t>(corner.y()),
          static_cast<std::int64_t>(corner.z())};
}

}  // namespace

std::size_t DistinctPositions::CellHash::operator()(const Cell& cell) const {
  std::uint64_t hash = 0;
  for (const std::int64_t index : cell) {
    hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
  }
  return hash;
}

Eigen::Array3d DistinctPositions::scaled(const Eigen::Vector3d& point) const {
  return (point - origin_).array() / (2.0 * tolerance_);
}

int DistinctPositions::find(const Eigen::Vector3d& point) const {
  const Cell low = cell_of(scaled(point) - 0.5);
  int nearest = -1;
  double nearest_distance = tolerance_;
  for (int corner = 0; corner < 8; ++corner) {
    const Cell cell{low[0] + (corner & 1), low[1] + (corner >> 1 & 1), low[2] + (corner >> 2)};
    for (auto [entry, end] = cells_.equal_range(cell); entry != end; ++entry) {
      const int number = entry->second;
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
  cells_.emplace(cell_of(scaled(point)), number);
  return number;
}

}  // namespace billow::sim
