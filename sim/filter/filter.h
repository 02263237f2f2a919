// The low-pass filter of the paper: one linear operator on particle vectors, applied once per step.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include "sim/body/structure.h"
#include "sim/filter/filter_operator.h"
#include "sim/filter/filter_options.h"
#include "sim/filter/filter_scratch.h"

namespace billow::sim {

/// A filter as options describe it: the paper's (neighbour_filter.h) or levels (level_filter.h). Where it conserves,
/// rigid motions of a free body pass unchanged, so that the body keeps both momenta.
class Filter {
 public:
  /// Throws InputError on an option out of its range, or where no levels allow the ratio asked for. `structure` must
  /// outlive it and its copies.
  Filter(const Structure& structure, FilterOptions options);

  /// field <- F field, `passes` times. field (n x 3); position (n x 3) [m] is used by `current` distances and the
  /// conserving form; time [s] by lambda_keys.
  void apply(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field, FilterScratch& scratch) const;

  /// velocity = F field, then moved += h velocity, in one pass over memory where no body's momenta need restoring.
  /// `position` may be `moved`. `field` is left as anything.
  void apply_and_move(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field, double h,
                      Eigen::MatrixX3d& velocity, Eigen::MatrixX3d& moved, FilterScratch& scratch) const;
  /// kicked = velocity + h F field, likewise.
  void apply_and_kick(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field,
                      const Eigen::MatrixX3d& velocity, double h, Eigen::MatrixX3d& kicked,
                      FilterScratch& scratch) const;

  /// As given; level shares that were left to be found are there.
  const FilterOptions& options() const { return options_; }
  /// Whether it is self-adjoint in the masses' inner product, over fields that are zero in pinned rows: the conserving
  /// form, levels, and others where no mass differs from what their weights call for. At the weights of rest and time
  /// 0.
  bool self_adjoint() const { return operator_->self_adjoint(); }
  /// Whether it is known to be self-adjoint without a negative eigenvalue whatever the structure.
  bool nonnegative() const { return operator_->nonnegative(); }
  /// Whether its weights depend neither on time nor on the shape.
  bool constant_weights() const { return operator_->constant(); }
  /// The levels of every body; empty where it is not made of levels.
  std::vector<LevelTable> levels() const { return operator_->levels(); }
  /// As it is at `time` [s] at rest distances, for good.
  Filter frozen(double time) const;
  /// M^-1 F^T M over such fields, as a filter. Throws std::logic_error where the weights change.
  Filter adjoint() const;
  /// F of one application as `position` and `time` make it, rigid motions aside (n x n), for tests and analysis.
  Eigen::SparseMatrix<double, Eigen::RowMajor> weights(const Eigen::MatrixX3d& position, double time) const {
    return operator_->matrix(position, time);
  }

 private:
  void take_rigid_motion(const Eigen::MatrixX3d& position, Eigen::MatrixX3d& field, FilterScratch& scratch) const;
  void put_rigid_motion(const Eigen::MatrixX3d& position, Eigen::MatrixX3d& field, const FilterScratch& scratch) const;
  void apply_once(Eigen::MatrixX3d& field, FilterScratch& scratch) const;
  void apply_last(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field, FilterColumns columns,
                  FilterScratch& scratch) const;

  const Structure* structure_;
  FilterOptions options_;
  std::shared_ptr<const FilterOperator> operator_;
  bool restores_momenta_ = false;  // some body's, that is free
};

}  // namespace billow::sim
