// Weights and application of the low-pass filter.
#include "sim/filter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/error.h"
#include "sim/filter_pass.h"
#include "sim/parallel.h"
#include "sim/random.h"
#include "sim/regular_values.h"

namespace billow::sim {

std::string_view name(FilterTarget target) { return target == FilterTarget::velocity ? "velocity" : "force"; }

namespace {

using Pair = std::pair<int, int>;

constexpr int least_part = 2048;  // particles

// Both directions of every spring.
std::vector<Pair> spring_neighbours(const Structure& structure) {
  std::vector<Pair> pairs;
  pairs.reserve(2 * structure.springs());
  for (int s = 0; s < structure.springs(); ++s) {
    pairs.emplace_back(structure.spring(s, 0), structure.spring(s, 1));
    pairs.emplace_back(structure.spring(s, 1), structure.spring(s, 0));
  }
  return pairs;
}

// A regular cloth has neighbours at exactly a round radius; this share more lets none of them come and go with the
// rounding of a mesh file's decimals.
constexpr double radius_slack = 1e-4;

// All pairs of one body within `radius` [m] at rest: a sweep along x.
void append_pairs_within(const Structure& structure, const Body& body, double radius, std::vector<Pair>& pairs) {
  std::vector<int> order(body.particles);
  std::iota(order.begin(), order.end(), body.first_particle);
  const auto x = [&](int i) { return structure.rest_position(i, 0); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return std::pair(x(a), a) < std::pair(x(b), b); });
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size() && x(order[b]) - x(order[a]) <= radius; ++b) {
      const int i = order[a], j = order[b];
      if ((structure.rest_position.row(i) - structure.rest_position.row(j)).norm() > radius) continue;
      pairs.emplace_back(i, j);
      pairs.emplace_back(j, i);
    }
}

std::vector<Pair> neighbour_pairs(const Structure& structure, const FilterOptions& options) {
  std::vector<Pair> pairs;
  if (options.neighbours == FilterNeighbours::springs)
    pairs = spring_neighbours(structure);
  else
    for (const Body& body : structure.body)
      append_pairs_within(structure, body, (1.0 + radius_slack) * options.radius * body.mean_rest_length, pairs);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

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
  require(o.lambda_scale.size() == 0 || o.lambda_scale.size() == structure.particles(),
          "the filter's lambda_scale needs one value per particle");
  require((o.lambda_scale.array() > 0.0).all() && o.lambda_scale.allFinite(),
          "lambda must be a positive number at every particle");
  for (const auto& [time, factor] : o.lambda_keys)
    require(factor > 0.0 && std::isfinite(factor), "lambda must be a positive number at every time");
  for (std::size_t k = 1; k < o.lambda_keys.size(); ++k)
    require(o.lambda_keys[k - 1].first < o.lambda_keys[k].first, "the filter's times for lambda must be ascending");
}

// Linear between keys, constant outside them.
double key_factor(const std::vector<std::pair<double, double>>& keys, double time) {
  if (keys.empty()) return 1.0;
  if (time <= keys.front().first) return keys.front().second;
  for (std::size_t k = 1; k < keys.size(); ++k)
    if (time < keys[k].first) {
      const double t = (time - keys[k - 1].first) / (keys[k].first - keys[k - 1].first);
      return keys[k - 1].second + t * (keys[k].second - keys[k - 1].second);
    }
  return keys.back().second;
}

// beta(d) / beta(0): the common factor lambda cancels when the weights are normalised.
double kernel(FilterKernel kind, double lambda, double distance) {
  const double t = lambda * distance;
  return kind == FilterKernel::exponential ? std::exp(-t) : std::exp(-0.5 * t * t);
}

bool is_free(const Structure& structure, const Body& body) {
  return (structure.inverse_mass.segment(body.first_particle, body.particles).array() > 0.0).all();
}

/// Linear and angular momentum of one body about its centre of mass, and its inertia there.
struct BodyMotion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  double mass = 0.0;
};

BodyMotion body_motion(const Structure& structure, const Body& body, const Eigen::MatrixX3d& position,
                       const Eigen::MatrixX3d& field) {
  BodyMotion motion;
  const int begin = body.first_particle, end = begin + body.particles;
  for (int i = begin; i < end; ++i) {
    motion.mass += structure.mass(i);
    motion.centre += structure.mass(i) * position.row(i).transpose();
    motion.linear += structure.mass(i) * field.row(i).transpose();
  }
  motion.centre /= motion.mass;
  for (int i = begin; i < end; ++i) {
    const Eigen::Vector3d r = position.row(i).transpose() - motion.centre, v = field.row(i);
    motion.angular += structure.mass(i) * r.cross(v);
    motion.inertia += structure.mass(i) * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return motion;
}

// Adds the rigid motion V + omega x r that brings the body's momenta back to `before`. A body on a line has no inertia
// about it; the pseudo-inverse leaves that axis alone.
void restore_momenta(const Structure& structure, const Body& body, const Eigen::MatrixX3d& position,
                     const BodyMotion& before, Eigen::MatrixX3d& field) {
  const BodyMotion after = body_motion(structure, body, position, field);
  const Eigen::Vector3d shift = (before.linear - after.linear) / after.mass;
  const Eigen::Vector3d spin =
      after.inertia.completeOrthogonalDecomposition().solve(Eigen::Vector3d(before.angular - after.angular));
  for (int i = body.first_particle; i < body.first_particle + body.particles; ++i) {
    const Eigen::Vector3d r = position.row(i).transpose() - after.centre;
    field.row(i) += (shift + spin.cross(r)).transpose();
  }
}

}  // namespace

Filter::Filter(const Structure& structure, FilterOptions options)
    : structure_(structure), options_(std::move(options)), unit_(distance_unit(structure)) {
  check(structure, options_);
  const std::vector<Pair> pairs = neighbour_pairs(structure, options_);
  pattern_.first.assign(structure.particles() + 1, 0);
  for (const auto& [i, j] : pairs) ++pattern_.first[i + 1], pattern_.column.push_back(j);
  std::partial_sum(pattern_.first.begin(), pattern_.first.end(), pattern_.first.begin());
  distance_.resize(pairs.size());
  for (std::size_t e = 0; e < pairs.size(); ++e) {
    const auto [i, j] = pairs[e];
    distance_(e) = (structure.rest_position.row(i) - structure.rest_position.row(j)).norm() / unit_(i);
  }
  for (const Body& body : structure.body) {
    const int begin = pattern_.first[body.first_particle], end = pattern_.first[body.first_particle + body.particles];
    make_regular(distance_.segment(begin, end - begin));
  }
  plan_ = FilterPlan(structure, pattern_);
  strength_ = Eigen::VectorXd::Ones(structure.particles());
  if (options_.form == FilterForm::conserving) keep_spectrum_positive();
  if (!constant_weights()) return;
  rest_weights_ = arranged(compute_weights(nullptr, 0.0));
  plan_.share_equal_groups(rest_weights_);
}

bool Filter::constant_weights() const {
  return options_.distances == FilterDistances::rest && options_.lambda_keys.empty();
}

Filter::Weights Filter::compute_weights(const Eigen::MatrixX3d* position, double time) const {
  const double lambda = options_.lambda * key_factor(options_.lambda_keys, time);
  Weights weights{Eigen::VectorXd(structure_.particles()), Eigen::VectorXd(distance_.size())};
  for (int i = 0; i < structure_.particles(); ++i) {
    const double scale = options_.lambda_scale.size() ? options_.lambda_scale(i) : 1.0;
    double sum = 1.0;  // the particle itself, at distance 0
    for (int e = pattern_.first[i]; e < pattern_.first[i + 1]; ++e) {
      const double distance =
          position ? (position->row(i) - position->row(pattern_.column[e])).norm() / unit_(i) : distance_(e);
      sum += weights.neighbour(e) = kernel(options_.kernel, lambda * scale, distance);
    }
    // symmetric: sum_j beta_j (v_j + v_i) / 2 = (I + B) / 2
    const double half = options_.form == FilterForm::symmetric ? 0.5 : 1.0;
    const double factor = structure_.pinned(i) ? 0.0 : half / sum;
    double neighbours = 0.0;
    for (int e = pattern_.first[i]; e < pattern_.first[i + 1]; ++e) neighbours += weights.neighbour(e) *= factor;
    weights.self(i) = 1.0 - neighbours;
  }
  if (options_.form == FilterForm::conserving) symmetrise_with_masses(weights), soften(weights);
  return weights;
}

// F <- (1 - strength) I + strength F, body by body
void Filter::soften(Weights& weights) const {
  for (int i = 0; i < structure_.particles(); ++i) {
    weights.neighbour.segment(pattern_.first[i], pattern_.first[i + 1] - pattern_.first[i]) *= strength_(i);
    weights.self(i) = (1.0 - strength_(i)) + strength_(i) * weights.self(i);
  }
}

// Each body's smallest eigenvalue of F at rest where it filters most, by power iteration on I - F in the masses' inner
// product, three vectors at a time. A thousandth is added for what the iteration has not reached.
void Filter::keep_spectrum_positive() {
  double strongest = 0.0;  // the time of the smallest lambda
  for (const auto& [time, factor] : options_.lambda_keys)
    if (factor < key_factor(options_.lambda_keys, strongest)) strongest = time;
  const PlacedWeights weights = arranged(compute_weights(nullptr, strongest));
  const Eigen::VectorXd free = structure_.inverse_mass.cwiseSign();
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(structure_.body.size());
  Eigen::MatrixX3d v = free.asDiagonal() * seeded_noise(structure_.particles(), 1);
  for (int k = 0; k < 500; ++k) {
    const Eigen::MatrixX3d before = v;
    apply_once(weights, v);
    v = free.asDiagonal() * (before - v);
    const Eigen::MatrixX3d weighted = structure_.mass.asDiagonal() * before;
    for (std::size_t b = 0; b < structure_.body.size(); ++b) {
      const auto rows = Eigen::seqN(structure_.body[b].first_particle, structure_.body[b].particles);
      const Eigen::RowVector3d square =
          before(rows, Eigen::all).cwiseProduct(weighted(rows, Eigen::all)).colwise().sum();
      const Eigen::RowVector3d product = v(rows, Eigen::all).cwiseProduct(weighted(rows, Eigen::all)).colwise().sum();
      if (!(square.minCoeff() > 0.0)) continue;  // nothing is exchanged at all
      largest(b) = product.cwiseQuotient(square).maxCoeff();
      v(rows, Eigen::all) /= std::max(v(rows, Eigen::all).norm(), 1e-300);
    }
  }
  for (std::size_t b = 0; b < structure_.body.size(); ++b)
    strength_.segment(structure_.body[b].first_particle, structure_.body[b].particles)
        .setConstant(1.0 / std::max(1.0, largest(b) + 1e-3));
}

// Row i gives m_i b_ij of its momentum to j and takes m_j b_ji. With the smaller of the two both ways nothing is lost,
// and no row's weights grow past 1.
void Filter::symmetrise_with_masses(Weights& weights) const {
  Weights result = weights;
  for (int i = 0; i < structure_.particles(); ++i) {
    if (structure_.pinned(i)) continue;
    double neighbours = 0.0;
    for (int e = pattern_.first[i]; e < pattern_.first[i + 1]; ++e) {
      const int j = pattern_.column[e];
      const auto row = pattern_.column.begin() + pattern_.first[j],
                 row_end = pattern_.column.begin() + pattern_.first[j + 1];
      const auto back = std::lower_bound(row, row_end, i) - pattern_.column.begin();
      const double forth = structure_.mass(i) * weights.neighbour(e);
      const double exchange =
          structure_.pinned(j) ? forth : std::min(forth, structure_.mass(j) * weights.neighbour(back));
      neighbours += result.neighbour(e) = exchange / structure_.mass(i);
    }
    result.self(i) = 1.0 - neighbours;
  }
  weights = std::move(result);
}

PlacedWeights Filter::arranged(const Weights& weights) const { return plan_.place(weights.self, weights.neighbour); }

namespace {

FilterColumns columns_of(const Eigen::MatrixX3d& in, Eigen::MatrixX3d& out) {
  FilterColumns columns{};
  for (int axis = 0; axis < 3; ++axis) columns.in[axis] = in.col(axis).data(), columns.out[axis] = out.col(axis).data();
  return columns;
}

}  // namespace

void Filter::run(const PlacedWeights& weights, const FilterColumns& columns) const {
  for (const FilterBands& bands : plan_.bands)
    for_each_range(bands.particles, band_group, least_part,
                   [&](int begin, int end) { filter_bands(bands, weights, columns, begin, end); });
  for (const FilterSlices& slices : plan_.slices) {
    for_each_block(slices.particles, static_cast<int>(slices.block.size()),
                   [&](int block) { filter_slices(slices, weights, columns, block); });
    if (!columns.base[0] && !columns.moved[0]) continue;
    for_each_range(slices.particles, 1, least_part, [&](int begin, int end) {
      put_filtered(columns, slices.first_particle + begin, slices.first_particle + end);
    });
  }
}

// Into a second field that each thread keeps, which then changes places with the first.
void Filter::apply_once(const PlacedWeights& weights, Eigen::MatrixX3d& field) const {
  static thread_local Eigen::MatrixX3d filtered;
  filtered.resize(field.rows(), 3);
  run(weights, columns_of(field, filtered));
  field.swap(filtered);
}

template <class Work>
void Filter::with_weights(const Eigen::MatrixX3d& position, double time, const Work& work) const {
  if (constant_weights()) return work(rest_weights_);
  const bool current = options_.distances == FilterDistances::current;
  work(arranged(compute_weights(current ? &position : nullptr, time)));
}

bool Filter::restores_momenta() const {
  return options_.form == FilterForm::conserving &&
         std::any_of(structure_.body.begin(), structure_.body.end(),
                     [&](const Body& body) { return is_free(structure_, body); });
}

void Filter::apply(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field) const {
  std::vector<BodyMotion> before;
  if (restores_momenta())
    for (const Body& body : structure_.body) before.push_back(body_motion(structure_, body, position, field));
  with_weights(position, time, [&](const PlacedWeights& weights) {
    for (int pass = 0; pass < options_.passes; ++pass) apply_once(weights, field);
  });
  for (std::size_t b = 0; b < before.size(); ++b)
    if (is_free(structure_, structure_.body[b]))
      restore_momenta(structure_, structure_.body[b], position, before[b], field);
}

// The last pass writes where `columns` say.
void Filter::apply_last(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field,
                        FilterColumns columns) const {
  with_weights(position, time, [&](const PlacedWeights& weights) {
    for (int pass = 1; pass < options_.passes; ++pass) apply_once(weights, field);
    for (int axis = 0; axis < 3; ++axis) columns.in[axis] = field.col(axis).data();
    run(weights, columns);
  });
}

void Filter::apply_and_move(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field, double h,
                            Eigen::MatrixX3d& velocity, Eigen::MatrixX3d& moved) const {
  if (restores_momenta()) {
    apply(position, time, field);
    velocity = field;
    moved += h * velocity;
    return;
  }
  FilterColumns columns = columns_of(field, velocity);
  columns.move_step = h;
  for (int axis = 0; axis < 3; ++axis) columns.moved[axis] = moved.col(axis).data();
  apply_last(position, time, field, columns);
}

void Filter::apply_and_kick(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field,
                            const Eigen::MatrixX3d& velocity, double h, Eigen::MatrixX3d& kicked) const {
  if (restores_momenta()) {
    apply(position, time, field);
    kicked = velocity + h * field;
    return;
  }
  kicked.resize(field.rows(), 3);
  FilterColumns columns = columns_of(field, kicked);
  columns.kick_step = h;
  for (int axis = 0; axis < 3; ++axis) columns.base[axis] = velocity.col(axis).data();
  apply_last(position, time, field, columns);
}

Eigen::SparseMatrix<double, Eigen::RowMajor> Filter::weights(const Eigen::MatrixX3d& position, double time) const {
  const bool current = options_.distances == FilterDistances::current;
  const Weights weights = compute_weights(current ? &position : nullptr, time);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < structure_.particles(); ++i) {
    entries.emplace_back(i, i, weights.self(i));
    for (int e = pattern_.first[i]; e < pattern_.first[i + 1]; ++e)
      entries.emplace_back(i, pattern_.column[e], weights.neighbour(e));
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(structure_.particles(), structure_.particles());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace billow::sim
