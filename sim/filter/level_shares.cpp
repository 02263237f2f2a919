// Eigenvalues of every level, and the root in a.
#include "sim/filter/level_shares.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "base/error.h"
#include "sim/filter/spring_bound.h"
#include "sim/linear/lanczos.h"

namespace billow::sim {

namespace {

using Laplacian = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr double eigenvalue_tolerance = 2e-3;  // of their error bounds; they count with it
constexpr double least_share = 1e-9;           // of the last level: else it is not needed
constexpr double share_tolerance = 3e-3;       // R may be missed by so much, from below
constexpr double reserve = 0.9;                // of R, that the last level stays below

/// lambda_max(F M^-1 L) of one body.
class BodySpectrum {
 public:
  BodySpectrum(const Structure& structure, const Body& body, const Laplacian& laplacian, LevelSum& sum)
      : structure_(structure), laplacian_(laplacian), sum_(sum), mass_(free_mass(structure, body)) {}

  double unfiltered() const { return largest({}); }
  double filtered(LevelShares shares) {
    sum_.set_shares(std::move(shares));
    return largest([this](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
      y.setZero(x.rows(), 3);
      sum_.run(columns_of(x, y), scratch_);
    });
  }

 private:
  double largest(const ParticleOperator& filter) const {
    const auto acceleration = [this](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
      y = structure_.inverse_mass.asDiagonal() * (laplacian_ * x);
    };
    return largest_eigenvalue({acceleration, filter, mass_}, {.tolerance = eigenvalue_tolerance}).upper();
  }

  const Structure& structure_;
  const Laplacian& laplacian_;
  LevelSum& sum_;
  Eigen::VectorXd mass_;
  FilterScratch scratch_;
};

LevelShares only(std::size_t level, double correction = 0.0) {
  LevelShares shares{std::vector<double>(level + 1, 0.0), correction};
  shares.gamma.back() = 1.0;
  return shares;
}

/// The largest value up to `high` at which an eigenvalue that is convex in it stays below `most`, by false position:
/// `low` 0 is known to. Less than `tolerance` of `most` is left unused, unless `high` itself holds.
double largest_below(double most, double at_low, double high, double tolerance,
                     const std::function<double(double)>& eigenvalue) {
  double low = 0.0, at_high = eigenvalue(high);
  if (at_high <= most) return high;
  const double narrow = 1e-3 * high;
  while (most - at_low > tolerance * most && high - low > narrow) {
    const double aim = most * (1.0 - 0.3 * tolerance);
    const double middle = low + std::clamp((aim - at_low) / (at_high - at_low), 0.02, 0.98) * (high - low);
    const double value = eigenvalue(middle);
    (value <= most ? low : high) = middle;
    (value <= most ? at_low : at_high) = value;
  }
  return low;
}

// The last level passes smooth fields the better the larger its correction, and its eigenvalue grows with that.
double largest_correction(BodySpectrum& spectrum, double most, double rho, std::size_t level) {
  constexpr double rough = 0.05;
  return largest_below(most, rho, 1.0, rough, [&](double c) { return spectrum.filtered(only(level, c)); });
}

// The shares that come with a.
LevelShares shares_at(double a, double most, const std::vector<double>& rho, double correction) {
  LevelShares shares{{}, correction};
  double rest = 1.0;
  for (std::size_t l = 0; l + 1 < rho.size(); ++l) {
    shares.gamma.push_back(a * most / rho[l]);
    rest -= shares.gamma.back();
  }
  shares.gamma.push_back(rest);
  return shares;
}

// Where the finer levels alone are more than enough: as much of no filter as is allowed, the last one left out.
LevelShares nearer_to_none(BodySpectrum& spectrum, double most, LevelShares shares) {
  shares.gamma.pop_back();
  shares.correction = 0.0;
  const auto mixed = [&](double none) {
    LevelShares result = shares;
    for (double& gamma : result.gamma) gamma *= 1.0 - none;
    result.gamma[0] += none;
    return result;
  };
  const double none = largest_below(most, spectrum.filtered(shares), 1.0, share_tolerance,
                                    [&](double share) { return spectrum.filtered(mixed(share)); });
  return mixed(none);
}

LevelShares weakest_shares(BodySpectrum& spectrum, double most, const std::vector<double>& rho) {
  const std::size_t last = rho.size() - 1;
  const double correction = largest_correction(spectrum, reserve * most, rho[last], last);
  double total = 0.0;
  for (std::size_t l = 0; l < last; ++l) total += most / rho[l];
  const double a = largest_below(most, reserve * most, 1.0 / total, share_tolerance, [&](double tried) {
    return spectrum.filtered(shares_at(tried, most, rho, correction));
  });
  const LevelShares shares = shares_at(a, most, rho, correction);
  return shares.gamma.back() < least_share ? nearer_to_none(spectrum, most, shares) : shares;
}

std::string too_much(const Body& body, double most, double ratio, double least_rho) {
  const double reached = std::floor(100.0 * ratio * std::sqrt(reserve * most / least_rho)) / 100.0;
  return fmt::format("levels of '{}' allow at most {:.2f} times the unfiltered step; use a smaller ratio or step",
                     body.name, reached);
}

void find_for_body(BodySpectrum& spectrum, const Body& body, double most, double ratio, LevelSum& sum) {
  std::vector<double> rho{spectrum.unfiltered()};
  while (rho.back() >= reserve * most) {
    if (rho.size() == 1 && rho.back() <= most * (1.0 + eigenvalue_tolerance)) break;
    if (static_cast<int>(rho.size()) == sum.levels())
      throw InputError(too_much(body, most, ratio, *std::min_element(rho.begin(), rho.end())));
    rho.push_back(spectrum.filtered(only(rho.size())));
  }
  sum.set_shares(rho.size() == 1 ? only(0) : weakest_shares(spectrum, most, rho));
}

}  // namespace

void find_level_shares(const Structure& structure, double ratio, std::vector<LevelSum>& bodies) {
  if (!(ratio >= 1.0) || !std::isfinite(ratio)) throw InputError("the filter's ratio must be a number of at least 1");
  const Laplacian laplacian = spring_bound(structure);
  std::vector<BodySpectrum> spectrum;
  double largest = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    spectrum.emplace_back(structure, structure.body[b], laplacian, bodies[b]);
    largest = std::max(largest, spectrum.back().unfiltered());
  }
  for (std::size_t b = 0; b < bodies.size(); ++b)
    find_for_body(spectrum[b], structure.body[b], largest / (ratio * ratio), ratio, bodies[b]);
}

}  // namespace billow::sim
