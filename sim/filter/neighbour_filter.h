// The paper's filter: means over each particle's neighbours.
#pragma once

#include "sim/filter/filter_neighbours.h"
#include "sim/filter/filter_operator.h"
#include "sim/filter/filter_options.h"
#include "sim/pass/filter_plan.h"

namespace billow::sim {

/// F of the paper's section 4.1 with weights normalised to 1 (method.md section 3). A pinned particle keeps its value
/// but counts as a neighbour. Bodies never mix: neighbours are found within a body.
///
/// The conserving form exchanges min(m_i b_ij, m_j b_ji) of momentum both ways between neighbours, which is symmetric
/// in the masses' inner product; where a body's smallest eigenvalue at rest is negative, as on some irregular meshes,
/// all its exchanges are scaled down until it is 0. A negative response would turn the restoring forces of a force
/// filter around.
class NeighbourFilter : public FilterOperator {
 public:
  /// Throws InputError on an option out of its range. `structure` must outlive it.
  NeighbourFilter(const Structure& structure, FilterOptions options);

  void prepare(const Eigen::MatrixX3d& position, double time, FilterScratch& scratch) const override;
  void run(const FilterColumns& columns, FilterScratch& scratch) const override;
  bool self_adjoint() const override;
  bool nonnegative() const override { return options_.form == FilterForm::conserving; }
  bool constant() const override;
  std::shared_ptr<const FilterOperator> frozen(double time) const override;
  std::shared_ptr<const FilterOperator> adjoint() const override;
  /// The row-normalised weights B in force.
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(const Eigen::MatrixX3d& position, double time) const override;

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
  void pass(const PlacedWeights& weights, const FilterColumns& columns, PassScratch& scratch) const;

  const Structure& structure_;
  FilterOptions options_;
  Eigen::VectorXd unit_;  // (n) [m] the body's mean rest length
  FilterNeighbourhood neighbours_;
  FilterPlan plan_;
  PlacedWeights rest_weights_;  // constant ones, in the plan's order
  Eigen::VectorXd strength_;    // (n) share of the conserving form's exchange that keeps its body's spectrum in [0, 1]
};

}  // namespace billow::sim
