// Points told apart by position: which of them are copies of which.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace billow::sim {

/// Distinct positions, numbered in the order they were added. Positions within `tolerance` are the same.
class DistinctPositions {
 public:
  /// `origin` is any point of the mesh; tolerance [m] > 0, and no point farther than 2^62 tolerances from the origin.
  DistinctPositions(const Eigen::Vector3d& origin, double tolerance) : origin_(origin), tolerance_(tolerance) {}

  /// The number of the nearest position within the tolerance of `point`, or -1.
  int find(const Eigen::Vector3d& point) const;

  /// The number of the position that `point` is a copy of, or of `point` itself if it is new.
  int find_or_add(const Eigen::Vector3d& point);

 private:
  using Cell = std::array<std::int64_t, 3>;

  Eigen::Array3d scaled(const Eigen::Vector3d& point) const;
  std::size_t bucket_of(const Cell& cell) const;
  int find_equal(const Eigen::Vector3d& point) const;
  void link(int number);
  void make_room();

  Eigen::Vector3d origin_;
  double tolerance_;
  std::vector<Eigen::Vector3d> positions_;
  // Chains of positions whose cells share a bucket: the first of each, and the one after each position; -1 ends a
  // chain.
  std::vector<int> first_, next_;
};

}  // namespace billow::sim
