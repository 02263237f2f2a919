// What a filter can be told.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <utility>
#include <vector>

#include "base/words.h"

namespace billow::sim {

enum class FilterKernel { exponential, gaussian, levels };
enum class FilterForm { plain, symmetric, conserving };
enum class FilterTarget { velocity, force };
enum class FilterNeighbours { springs, radius };
enum class FilterDistances { rest, current };

Words<FilterKernel> words(FilterKernel);
Words<FilterForm> words(FilterForm);
Words<FilterTarget> words(FilterTarget);
Words<FilterNeighbours> words(FilterNeighbours);
Words<FilterDistances> words(FilterDistances);

/// The target's name as scenes and reports write it.
std::string_view name(FilterTarget target);

/// How much of every level a body's filter takes (level_filter.h).
struct LevelShares {
  std::vector<double> gamma;  // >= 0, of sum 1: of the particles, then of one level after the other; 0 beyond the last
  double correction = 0.0;    // c of the last one, 0 to 1
};

struct FilterOptions {
  // beta(d) = lambda e^(-lambda |d|), or lambda e^(-(lambda d)^2 / 2); levels have no beta, and nothing but `target`,
  // `ratio` and `level_share` of what follows is theirs.
  FilterKernel kernel = FilterKernel::exponential;
  double lambda = 1.0;  // [1 / mean rest length] > 0; smaller filters more
  FilterForm form = FilterForm::plain;
  FilterTarget target = FilterTarget::velocity;
  FilterNeighbours neighbours = FilterNeighbours::springs;
  double radius = 2.0;  // [mean rest length] for FilterNeighbours::radius
  FilterDistances distances = FilterDistances::rest;
  int passes = 1;                                           // times the operator is applied per step, >= 1
  Eigen::VectorXd particle_lambda = {};                     // (n) lambda of each particle; empty: `lambda` everywhere
  std::vector<std::pair<double, double>> lambda_keys = {};  // (time [s], factor on lambda), ascending; empty: 1 always
  double ratio = 6.0;  // levels: how many times the unfiltered step for any shape they are to allow, >= 1
  std::vector<LevelShares> level_shares = {};  // of every body; empty: found from `ratio`
};

/// The factor on lambda at `time` [s]: linear between keys, constant outside them.
double lambda_factor(const FilterOptions& options, double time);

/// With lambda as it is at `time` [s] at rest distances, for good.
FilterOptions frozen_options(FilterOptions options, double time);

/// When, within `duration` [s], the filter is weakest, lambda being largest, and when it is strongest: one moment where
/// lambda stays as it is.
std::vector<double> times_of_extremes(const FilterOptions& options, double duration);

}  // namespace billow::sim
