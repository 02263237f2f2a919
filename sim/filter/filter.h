// The low-pass filter of the paper: one linear operator on particle vectors, applied once per step.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "sim/body/structure.h"
#include "sim/filter/filter_neighbours.h"
#include "sim/filter/filter_options.h"
#include "sim/filter/filter_scratch.h"
#include "sim/pass/filter_plan.h"

namespace billow::sim {

struct FilterColumns;

/// F of the paper's section 4.1 with weights normalised to 1 (method.md section 3). A pinned particle keeps its value
/// but counts as a neighbour. Bodies never mix: neighbours are found within a body.
///
/// The conserving form exchanges min(m_i b_ij, m_j b_ji) of momentum both ways between neighbours, which is symmetric
/// in the masses' inner product; where a body's smallest eigenvalue at rest is negative, as on some irregular meshes,
/// all its exchanges are scaled down until it is 0. A negative response would turn the restoring forces of a force
/// filter around. Rigid motions of a free body pass unchanged, so it keeps both momenta.
class Filter {
 public:
  /// Throws InputError on an option out of its range.
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

  const FilterOptions& options() const { return options_; }
  /// Whether it is self-adjoint in the masses' inner product, over fields that are zero in pinned rows: the conserving
  /// form, and others where no mass differs from what their weights call for. At the weights of rest and time 0.
  bool self_adjoint() const;
  /// Whether its weights depend neither on time nor on the shape.
  bool constant_weights() const;
  /// As it is at `time` [s] at rest distances, for good.
  Filter frozen(double time) const;
  /// M^-1 F^T M over such fields, as a filter. Throws std::logic_error where the weights change.
  Filter adjoint() const;
  /// The row-normalised weights B in force at `position` and `time`, (n x n), for tests and analysis.
  Eigen::SparseMatrix<double, Eigen::RowMajor> weights(const Eigen::MatrixX3d& position, double time) const;

 private:
  void compute_weights(const Eigen::MatrixX3d* position, double time, FilterWeights& weights) const;
  void symmetrise_with_masses(FilterWeights& weights) const;
  FilterWeights adjoint_of(const FilterWeights& weights) const;
  Eigen::Index reverse_of(int i, int e) const;
  void soften(FilterWeights& weights) const;
  void keep_spectrum_positive();
  void set_rest_weights();
  Eigen::VectorXd largest_exchange(const PlacedWeights& weights) const;
  PlacedWeights arranged(const FilterWeights& weights) const;
  const PlacedWeights& weights_at(const Eigen::MatrixX3d& position, double time, FilterScratch& scratch) const;
  void take_rigid_motion(const Eigen::MatrixX3d& position, Eigen::MatrixX3d& field, FilterScratch& scratch) const;
  void put_rigid_motion(const Eigen::MatrixX3d& position, Eigen::MatrixX3d& field, const FilterScratch& scratch) const;
  void apply_once(const PlacedWeights& weights, Eigen::MatrixX3d& field, FilterScratch& scratch) const;
  void apply_last(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field, FilterColumns columns,
                  FilterScratch& scratch) const;
  void run(const PlacedWeights& weights, const FilterColumns& columns, PassScratch& scratch) const;

  const Structure& structure_;
  FilterOptions options_;
  Eigen::VectorXd unit_;  // (n) [m] the body's mean rest length
  FilterNeighbourhood neighbours_;
  FilterPlan plan_;
  PlacedWeights rest_weights_;  // constant ones, in the plan's order
  Eigen::VectorXd strength_;    // (n) share of the conserving form's exchange that keeps its body's spectrum in [0, 1]
  bool restores_momenta_ = false;  // some body's, that is free
};

}  // namespace billow::sim
