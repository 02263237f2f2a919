// What a filter is made of: one linear operator on particle vectors.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "sim/filter/filter_options.h"
#include "sim/filter/filter_scratch.h"
#include "sim/pass/filter_pass.h"

namespace billow::sim {

/// `in` filtered into `out`, both (n x 3).
inline FilterColumns columns_of(const Eigen::MatrixX3d& in, Eigen::MatrixX3d& out) {
  FilterColumns columns{};
  for (int axis = 0; axis < 3; ++axis) columns.in[axis] = in.col(axis).data(), columns.out[axis] = out.col(axis).data();
  return columns;
}

/// Levels of one body that take part, from the particles on.
struct LevelTable {
  std::vector<int> nodes;
  LevelShares shares;
};

/// One application of F. Pinned particles keep their value.
class FilterOperator {
 public:
  virtual ~FilterOperator() = default;
  /// To be called before `run` where the weights change: what they are at `position` (n x 3) and `time` [s].
  virtual void prepare(const Eigen::MatrixX3d& position, double time, FilterScratch& scratch) const = 0;
  /// F of the columns' field, and what else they say.
  virtual void run(const FilterColumns& columns, FilterScratch& scratch) const = 0;

  /// Whether it is self-adjoint in the masses' inner product, over fields that are zero in pinned rows, at time 0 and
  /// at rest.
  virtual bool self_adjoint() const = 0;
  /// Whether it is known to be self-adjoint without a negative eigenvalue whatever the structure.
  virtual bool nonnegative() const = 0;
  /// Whether its weights depend neither on time nor on the shape.
  virtual bool constant() const = 0;
  /// As it is at `time` [s] at rest distances, for good.
  virtual std::shared_ptr<const FilterOperator> frozen(double time) const = 0;
  /// M^-1 F^T M over fields that are zero in pinned rows. Only for constant ones.
  virtual std::shared_ptr<const FilterOperator> adjoint() const = 0;
  /// Of every body; empty where it is not made of levels.
  virtual std::vector<LevelTable> levels() const { return {}; }
  /// F itself (n x n), for tests and analysis.
  virtual Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(const Eigen::MatrixX3d& position, double time) const = 0;
};

}  // namespace billow::sim
