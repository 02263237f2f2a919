// Weights and application of the paper's filter.
#include "sim/filter/neighbour_filter.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "sim/linear/lanczos.h"
#include "sim/pass/filter_pass.h"

namespace billow::sim {

namespace {

Eigen::VectorXd distance_unit(const Structure& structure) {
  Eigen::VectorXd unit(structure.particles());
  for (const Body& body : structure.body)
    unit.segment(body.first_particle, body.particles).setConstant(body.mean_rest_length);
  return unit;
}

void require(bool holds, const char* message) {
  if (!holds) throw InputError(message);
}

void check(const Structure& structure, const FilterOptions& o) {
  require(o.lambda > 0.0 && std::isfinite(o.lambda), "the filter's lambda must be a positive number");
  require(o.passes >= 1, "the filter needs at least one pass");
  require(o.radius > 0.0, "the filter's radius must be positive");
  require(o.particle_lambda.size() == 0 || o.particle_lambda.size() == structure.particles(),
          "the filter's particle_lambda needs one value per particle");
  require((o.particle_lambda.array() > 0.0).all() && o.particle_lambda.allFinite(),
          "lambda must be a positive number at every particle");
  for (const auto& [time, factor] : o.lambda_keys)
    require(factor > 0.0 && std::isfinite(factor), "lambda must be a positive number at every time");
  for (std::size_t k = 1; k < o.lambda_keys.size(); ++k)
    require(o.lambda_keys[k - 1].first < o.lambda_keys[k].first, "the filter's times for lambda must be ascending");
}

// beta(d) / beta(0): the common factor lambda cancels when the weights are normalised.
double kernel(FilterKernel kind, double lambda, double distance) {
  const double t = lambda * distance;
  return kind == FilterKernel::exponential ? std::exp(-t) : std::exp(-0.5 * t * t);
}

}  // namespace

NeighbourFilter::NeighbourFilter(const Structure& structure, FilterOptions options)
    : structure_(structure), options_(std::move(options)), unit_(distance_unit(structure)) {
  check(structure, options_);
  neighbours_ = find_neighbours(structure, options_, unit_);
  plan_ = FilterPlan(structure, neighbours_.rows);
  strength_ = Eigen::VectorXd::Ones(structure.particles());
  if (options_.form == FilterForm::conserving) keep_spectrum_positive();
  if (constant()) set_rest_weights();
}

void NeighbourFilter::set_rest_weights() {
  FilterWeights weights;
  compute_weights(nullptr, 0.0, weights);
  rest_weights_ = arranged(weights);
  plan_.share_equal_groups(rest_weights_);
}

bool NeighbourFilter::constant() const {
  return options_.distances == FilterDistances::rest && options_.lambda_keys.empty();
}

void NeighbourFilter::compute_weights(const Eigen::MatrixX3d* position, double time, FilterWeights& weights) const {
  const auto& [first, column] = neighbours_.rows;
  const double factor_now = lambda_factor(options_, time);
  weights.self.resize(structure_.particles());
  weights.neighbour.resize(neighbours_.distance.size());
  for (int i = 0; i < structure_.particles(); ++i) {
    const double lambda =
        factor_now * (options_.particle_lambda.size() ? options_.particle_lambda(i) : options_.lambda);
    double sum = 1.0;  // the particle itself, at distance 0
    for (int e = first[i]; e < first[i + 1]; ++e) {
      const double distance =
          position ? (position->row(i) - position->row(column[e])).norm() / unit_(i) : neighbours_.distance(e);
      sum += weights.neighbour(e) = kernel(options_.kernel, lambda, distance);
    }
    // symmetric: sum_j beta_j (v_j + v_i) / 2 = (I + B) / 2
    const double half = options_.form == FilterForm::symmetric ? 0.5 : 1.0;
    const double factor = structure_.pinned(i) ? 0.0 : half / sum;
    double neighbours = 0.0;
    for (int e = first[i]; e < first[i + 1]; ++e) neighbours += weights.neighbour(e) *= factor;
    weights.self(i) = 1.0 - neighbours;
  }
  if (options_.form == FilterForm::conserving) symmetrise_with_masses(weights), soften(weights);
}

// F <- (1 - strength) I + strength F, body by body
void NeighbourFilter::soften(FilterWeights& weights) const {
  const std::vector<int>& first = neighbours_.rows.first;
  for (int i = 0; i < structure_.particles(); ++i) {
    weights.neighbour.segment(first[i], first[i + 1] - first[i]) *= strength_(i);
    weights.self(i) = (1.0 - strength_(i)) + strength_(i) * weights.self(i);
  }
}

// The share of every body's exchange that leaves no eigenvalue of F below 0, where it filters most: F = I - E has the
// smallest one 1 - (the largest of E).
void NeighbourFilter::keep_spectrum_positive() {
  FilterWeights weights;
  compute_weights(nullptr, times_of_extremes(options_, HUGE_VAL).back(), weights);
  const Eigen::VectorXd largest = largest_exchange(arranged(weights));
  for (std::size_t b = 0; b < structure_.body.size(); ++b)
    strength_.segment(structure_.body[b].first_particle, structure_.body[b].particles)
        .setConstant(1.0 / std::max(1.0, largest(b)));
}

// The largest eigenvalue of E = I - F of every body (b), from above.
Eigen::VectorXd NeighbourFilter::largest_exchange(const PlacedWeights& weights) const {
  constexpr double tolerance = 1e-3;
  FilterScratch scratch;
  const auto exchange = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
    pass(weights, columns_of(x, y), scratch.pass);
    y = x - y;
  };
  Eigen::VectorXd largest(structure_.body.size());
  for (std::size_t b = 0; b < structure_.body.size(); ++b) {
    const Eigen::VectorXd mass = free_mass(structure_, structure_.body[b]);
    largest(b) = largest_eigenvalue({exchange, {}, mass}, {.tolerance = tolerance, .scale = 1.0}).upper();
  }
  return largest;
}

// Row i gives m_i b_ij of its momentum to j and takes m_j b_ji. With the smaller of the two both ways nothing is lost,
// and no row's weights grow past 1.
void NeighbourFilter::symmetrise_with_masses(FilterWeights& weights) const {
  const auto& [first, column] = neighbours_.rows;
  FilterWeights result = weights;
  for (int i = 0; i < structure_.particles(); ++i) {
    if (structure_.pinned(i)) continue;
    double neighbours = 0.0;
    for (int e = first[i]; e < first[i + 1]; ++e) {
      const int j = column[e];
      const double forth = structure_.mass(i) * weights.neighbour(e), back = weights.neighbour(reverse_of(i, e));
      const double exchange = structure_.pinned(j) ? forth : std::min(forth, structure_.mass(j) * back);
      neighbours += result.neighbour(e) = exchange / structure_.mass(i);
    }
    result.self(i) = 1.0 - neighbours;
  }
  weights = std::move(result);
}

PlacedWeights NeighbourFilter::arranged(const FilterWeights& weights) const {
  PlacedWeights placed;
  plan_.place(weights.self, weights.neighbour, placed);
  return placed;
}

void NeighbourFilter::prepare(const Eigen::MatrixX3d& position, double time, FilterScratch& scratch) const {
  if (constant()) return;
  const bool current = options_.distances == FilterDistances::current;
  compute_weights(current ? &position : nullptr, time, scratch.weights);
  plan_.place(scratch.weights.self, scratch.weights.neighbour, scratch.placed);
}

void NeighbourFilter::run(const FilterColumns& columns, FilterScratch& scratch) const {
  pass(constant() ? rest_weights_ : scratch.placed, columns, scratch.pass);
}

void NeighbourFilter::pass(const PlacedWeights& weights, const FilterColumns& columns, PassScratch& scratch) const {
  scratch.prepare();
  for (const FilterBands& bands : plan_.bands)
    for_each_range(bands.particles, band_group, least_part_of_a_pass, [&](int part, int begin, int end) {
      filter_bands(bands, weights, columns, begin, end, scratch.part(part));
    });
  for (const FilterSlices& slices : plan_.slices) {
    const auto filter_blocks = [&](int part, int begin, int end) {
      for (int block = begin; block < end; ++block) filter_slices(slices, weights, columns, block, scratch.part(part));
    };
    for_each_range(static_cast<int>(slices.block.size()), 1, 1, filter_blocks, FilterSlices::block_particles);
    if (!columns.base[0] && !columns.moved[0]) continue;
    for_each_range(slices.particles, 1, least_part_of_a_pass, [&](int, int begin, int end) {
      put_filtered(columns, slices.first_particle + begin, slices.first_particle + end);
    });
  }
}

// Both directions of every exchange of momentum, m_i b_ij and m_j b_ji, by neighbour entry; weights of pinned particles
// count for nothing, as their velocities do.
bool NeighbourFilter::self_adjoint() const {
  constexpr double rounding = 1e-9;
  if (options_.form == FilterForm::conserving) return true;
  FilterWeights weights;
  compute_weights(nullptr, 0.0, weights);
  const FilterWeights adjoint = adjoint_of(weights);
  const auto& [first, column] = neighbours_.rows;
  for (int i = 0; i < structure_.particles(); ++i)
    for (int e = first[i]; e < first[i + 1]; ++e)
      if (!structure_.pinned(i) && !structure_.pinned(column[e]) &&
          std::abs(weights.neighbour(e) - adjoint.neighbour(e)) > rounding)
        return false;
  return true;
}

// What the conserving form is scaled down by stays, though it is found where lambda is smallest.
std::shared_ptr<const FilterOperator> NeighbourFilter::frozen(double time) const {
  auto result = std::make_shared<NeighbourFilter>(*this);
  result->options_ = frozen_options(options_, time);
  result->set_rest_weights();
  return result;
}

std::shared_ptr<const FilterOperator> NeighbourFilter::adjoint() const {
  auto result = std::make_shared<NeighbourFilter>(*this);
  FilterWeights weights;
  compute_weights(nullptr, 0.0, weights);
  if (options_.form != FilterForm::conserving) weights = adjoint_of(weights);
  result->rest_weights_ = arranged(weights);
  return result;
}

// M^-1 F^T M: b*_ij = m_j b_ji / m_i. The diagonal stays.
FilterWeights NeighbourFilter::adjoint_of(const FilterWeights& weights) const {
  const auto& [first, column] = neighbours_.rows;
  FilterWeights result = weights;
  for (int i = 0; i < structure_.particles(); ++i)
    for (int e = first[i]; e < first[i + 1]; ++e)
      result.neighbour(e) = structure_.mass(column[e]) / structure_.mass(i) * weights.neighbour(reverse_of(i, e));
  return result;
}

// Of the entry e of row i, which is j: the entry of row j that is i.
Eigen::Index NeighbourFilter::reverse_of(int i, int e) const {
  const auto& [first, column] = neighbours_.rows;
  const int j = column[e];
  return std::lower_bound(column.begin() + first[j], column.begin() + first[j + 1], i) - column.begin();
}

Eigen::SparseMatrix<double, Eigen::RowMajor> NeighbourFilter::matrix(const Eigen::MatrixX3d& position,
                                                                     double time) const {
  const bool current = options_.distances == FilterDistances::current;
  const auto& [first, column] = neighbours_.rows;
  FilterWeights weights;
  compute_weights(current ? &position : nullptr, time, weights);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < structure_.particles(); ++i) {
    entries.emplace_back(i, i, weights.self(i));
    for (int e = first[i]; e < first[i + 1]; ++e) entries.emplace_back(i, column[e], weights.neighbour(e));
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(structure_.particles(), structure_.particles());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace billow::sim
