// The low-pass filter of the paper: one linear operator on particle vectors, applied once per step.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/filter_plan.h"
#include "sim/structure.h"

namespace billow::sim {

struct FilterColumns;

enum class FilterKernel { exponential, gaussian };
enum class FilterForm { plain, symmetric, conserving };
enum class FilterTarget { velocity, force };
/// The target's name as scenes and reports write it.
std::string_view name(FilterTarget target);

enum class FilterNeighbours { springs, radius };
enum class FilterDistances { rest, current };

struct FilterOptions {
  FilterKernel kernel = FilterKernel::exponential;  // beta(d) = lambda e^(-lambda |d|), or lambda e^(-(lambda d)^2 / 2)
  double lambda = 1.0;                              // [1 / mean rest length] > 0; smaller filters more
  FilterForm form = FilterForm::plain;
  FilterTarget target = FilterTarget::velocity;
  FilterNeighbours neighbours = FilterNeighbours::springs;
  double radius = 2.0;  // [mean rest length] for FilterNeighbours::radius
  FilterDistances distances = FilterDistances::rest;
  int passes = 1;                                           // times the operator is applied per step, >= 1
  Eigen::VectorXd lambda_scale = {};                        // (n) factor on lambda per particle; empty: 1 everywhere
  std::vector<std::pair<double, double>> lambda_keys = {};  // (time [s], factor on lambda), ascending; empty: 1 always
};

/// F of the paper's section 4.1 with weights normalised to 1 (method.md section 3). A pinned particle keeps its value
/// but counts as a neighbour. Bodies never mix: neighbours are found within a body.
///
/// The conserving form exchanges min(m_i b_ij, m_j b_ji) of momentum both ways between neighbours, which is symmetric
/// in the masses' inner product; where a body's smallest eigenvalue at rest is negative, as on some irregular meshes,
/// all its exchanges are scaled down until it is 0. A negative response would turn the restoring forces of a force
/// filter around. A free body then gets its angular momentum back as a rigid rotation.
class Filter {
 public:
  /// Throws InputError on an option out of its range.
  Filter(const Structure& structure, FilterOptions options);

  /// field <- F field, `passes` times. field (n x 3); position (n x 3) [m] is used by `current` distances and the
  /// conserving form; time [s] by lambda_keys.
  void apply(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field) const;

  /// velocity = F field, then moved += h velocity, in one pass over memory where no body's momenta need restoring.
  /// `position` may be `moved`. `field` is left as anything.
  void apply_and_move(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field, double h,
                      Eigen::MatrixX3d& velocity, Eigen::MatrixX3d& moved) const;
  /// kicked = velocity + h F field, likewise.
  void apply_and_kick(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field,
                      const Eigen::MatrixX3d& velocity, double h, Eigen::MatrixX3d& kicked) const;

  const FilterOptions& options() const { return options_; }
  /// The row-normalised weights B in force at `position` and `time`, (n x n), for tests and analysis.
  Eigen::SparseMatrix<double, Eigen::RowMajor> weights(const Eigen::MatrixX3d& position, double time) const;

 private:
  struct Weights {
    Eigen::VectorXd self;       // (n)
    Eigen::VectorXd neighbour;  // one per entry of the pattern
  };

  Weights compute_weights(const Eigen::MatrixX3d* position, double time) const;
  void symmetrise_with_masses(Weights& weights) const;
  void soften(Weights& weights) const;
  void keep_spectrum_positive();
  PlacedWeights arranged(const Weights& weights) const;
  void apply_once(const PlacedWeights& weights, Eigen::MatrixX3d& field) const;
  void apply_last(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field, FilterColumns columns) const;
  void run(const PlacedWeights& weights, const FilterColumns& columns) const;
  template <class Work>
  void with_weights(const Eigen::MatrixX3d& position, double time, const Work& work) const;
  bool constant_weights() const;
  bool restores_momenta() const;

  const Structure& structure_;
  FilterOptions options_;
  Eigen::VectorXd unit_;  // (n) [m] the body's mean rest length
  NeighbourRows pattern_;
  Eigen::VectorXd distance_;  // rest distance of each entry of the pattern, in mean rest lengths
  FilterPlan plan_;
  PlacedWeights rest_weights_;  // constant ones, in the plan's order
  Eigen::VectorXd strength_;    // (n) share of the conserving form's exchange that keeps its body's spectrum in [0, 1]
};

}  // namespace billow::sim
