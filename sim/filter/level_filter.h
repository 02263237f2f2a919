// Levels: a filter whose reach, and so whose step, does not depend on how fine the mesh is.
#pragma once

#include <memory>
#include <vector>

#include "sim/filter/filter_operator.h"
#include "sim/filter/filter_options.h"
#include "sim/levels/level_hierarchy.h"

namespace billow::sim {

/// F of one body as docs/method.md's "Levels" writes it: the sum over levels of gamma_l Q_l, Q_l = P_l D_l^-1 P_l^T M,
/// Q_0 = I. For the last level J that takes part, D^-1 gives way to (1 + c) D^-1 - c D^-1 P^T M P D^-1, c between 0 and
/// 1, which is nearer to the consistent mass' inverse: what is smooth passes as it is to one order more.
///
/// Self-adjoint in the masses' inner product; with gamma >= 0 of sum 1 its eigenvalues lie in [gamma_0, 1], and
/// constant fields of a free body pass unchanged.
class LevelSum {
 public:
  LevelSum(const Structure& structure, const Body& body);

  /// Levels there are, the particles themselves the first.
  int levels() const { return static_cast<int>(hierarchy_.level.size()) + 1; }
  /// How many nodes there are on one of them.
  int nodes(int level) const;
  void set_shares(LevelShares shares);
  const LevelShares& shares() const { return shares_; }

  void run(const FilterColumns& columns, FilterScratch& scratch) const;
  /// Its entries, at the body's particles.
  void add_to(std::vector<Eigen::Triplet<double>>& entries) const;

 private:
  const NodeLevel& level(std::size_t number) const { return hierarchy_.level[number - 1]; }
  void pass_through(const FilterColumns& columns) const;
  Eigen::SparseMatrix<double, Eigen::RowMajor> interpolation(int level) const;
  void correct(std::vector<AlignedVector<double>>& rows) const;

  int first_particle_, particles_;
  Eigen::VectorXd mass_;  // [kg] of the body's particles, 0 where pinned
  LevelHierarchy hierarchy_;
  LevelShares shares_;
  std::vector<Eigen::VectorXd> factor_;  // gamma_l D_l^-1 of every level that takes part but the particles'
  SparseRows correction_;                // (1 + c) I - c P^T M P D^-1 of the last; empty: I
};

/// Lives in a shared pointer, for it is its own adjoint and the same at all times.
class LevelFilter : public FilterOperator, public std::enable_shared_from_this<LevelFilter> {
 public:
  /// Finds the shares where the options have none. Throws InputError as find_level_shares does, or on shares of other
  /// bodies and levels than there are.
  LevelFilter(const Structure& structure, const FilterOptions& options);

  /// Of every body.
  std::vector<LevelShares> shares() const;

  void prepare(const Eigen::MatrixX3d&, double, FilterScratch&) const override {}
  void run(const FilterColumns& columns, FilterScratch& scratch) const override;
  bool self_adjoint() const override { return true; }
  bool nonnegative() const override { return true; }
  bool constant() const override { return true; }
  std::shared_ptr<const FilterOperator> frozen(double) const override { return shared_from_this(); }
  std::shared_ptr<const FilterOperator> adjoint() const override { return shared_from_this(); }
  std::vector<LevelTable> levels() const override;
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(const Eigen::MatrixX3d& position, double time) const override;

 private:
  int particles_;
  std::vector<LevelSum> body_;
};

}  // namespace billow::sim
