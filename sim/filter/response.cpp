// Rayleigh quotients of F, and of the springs, for given fields.
#include "sim/filter/response.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/filter/spring_bound.h"

namespace billow::sim {

namespace {

double inner(const Structure& structure, const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b) {
  return a.cwiseProduct(b).rowwise().sum().dot(free_mass(structure));
}

/// How far along its longest extent each particle of a body stands [m].
Eigen::VectorXd places_along(const Structure& structure, const Body& body) {
  const auto position = structure.rest_position.middleRows(body.first_particle, body.particles);
  int longest = 0;
  (position.colwise().maxCoeff() - position.colwise().minCoeff()).maxCoeff(&longest);
  return position.col(longest).array() - position.col(longest).minCoeff();
}

// Nothing of it lies in other bodies or at pins.
Eigen::MatrixX3d wave(const Structure& structure, const Body& body, const Eigen::VectorXd& place, double k) {
  Eigen::MatrixX3d field = Eigen::MatrixX3d::Zero(structure.particles(), 3);
  for (int i = 0; i < body.particles; ++i)
    if (!structure.pinned(body.first_particle + i)) field(body.first_particle + i, 2) = std::cos(k * place(i));
  return field;
}

}  // namespace

FilteredShare filtered_share(const Structure& structure, const Filter& filter, const Eigen::MatrixX3d& position,
                             double time, const Eigen::MatrixX3d& field, FilterScratch& scratch) {
  Eigen::MatrixX3d filtered = field;
  filter.apply(position, time, filtered, scratch);
  return {inner(structure, field, filtered), inner(structure, field, field)};
}

std::vector<WaveResponse> wave_responses(const Structure& structure, const Body& body, const Filter* filter,
                                         int count) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> bound = spring_bound(structure);
  const Eigen::VectorXd place = places_along(structure, body);
  const double longest = std::numbers::pi / place.maxCoeff(), shortest = std::numbers::pi / body.mean_rest_length;
  FilterScratch scratch;
  std::vector<WaveResponse> result;
  for (int k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / (count - 1);
    const Eigen::MatrixX3d field = wave(structure, body, place, longest * std::pow(shortest / longest, share));
    const double whole = inner(structure, field, field), stiffness = field.cwiseProduct(bound * field).sum();
    if (!(whole > 0.0)) continue;
    result.push_back({std::sqrt(std::max(0.0, stiffness) / whole) / (2.0 * std::numbers::pi), 1.0});
    if (filter)
      result.back().response =
          filtered_share(structure, *filter, structure.rest_position, 0.0, field, scratch).response();
  }
  return result;
}

}  // namespace billow::sim
