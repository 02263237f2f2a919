// Down to the coarsest level that takes part, and up again.
#include "sim/filter/level_filter.h"

#include <utility>

#include "base/error.h"
#include "sim/filter/level_shares.h"
#include "sim/pass/level_transfer.h"

namespace billow::sim {

LevelSum::LevelSum(const Structure& structure, const Body& body)
    : first_particle_(body.first_particle),
      particles_(body.particles),
      mass_(free_mass(structure).segment(body.first_particle, body.particles)),
      hierarchy_(build_levels(structure, body)),
      shares_{{1.0}, 0.0} {}

int LevelSum::nodes(int level) const {
  return level == 0 ? particles_ : hierarchy_.level[static_cast<std::size_t>(level) - 1].nodes();
}

namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

Matrix matrix_of(const SparseRows& rows, int columns) {
  return Eigen::Map<const Matrix>(rows.rows(), columns, static_cast<Eigen::Index>(rows.column.size()),
                                  rows.first.data(), rows.column.data(), rows.weight.data());
}

SparseRows rows_of(Matrix matrix) {
  matrix.makeCompressed();
  SparseRows rows;
  rows.first.assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.rows() + 1);
  rows.column.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
  rows.weight.assign(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros());
  return rows;
}

Eigen::VectorXd inverse_or_0(const Eigen::VectorXd& values) {
  return (values.array() > 0.0).select(values.array().inverse(), 0.0);
}

}  // namespace

void LevelSum::set_shares(LevelShares shares) {
  if (shares.gamma.empty() || static_cast<int>(shares.gamma.size()) > levels())
    throw InputError("a filter's level shares need a gamma for the particles, and none for levels that are not there");
  shares_ = std::move(shares);
  factor_.clear();
  for (std::size_t l = 1; l < shares_.gamma.size(); ++l)
    factor_.push_back(shares_.gamma[l] * inverse_or_0(hierarchy_.level[l - 1].mass));
  correction_ = {};
  if (factor_.empty() || shares_.correction == 0.0) return;
  const auto top = static_cast<int>(factor_.size());
  const Eigen::VectorXd inverse = inverse_or_0(hierarchy_.level[factor_.size() - 1].mass);
  Matrix identity(nodes(top), nodes(top));
  identity.setIdentity();
  const Matrix p = interpolation(top), overlap = Matrix(p.transpose()) * Matrix(mass_.asDiagonal() * p);
  correction_ =
      rows_of((1.0 + shares_.correction) * identity - shares_.correction * Matrix(overlap * inverse.asDiagonal()));
}

void LevelSum::run(const FilterColumns& columns, FilterScratch& scratch) const {
  const std::size_t top = factor_.size();
  if (top == 0) return pass_through(columns);
  std::vector<AlignedVector<double>>& rows = scratch.level;
  if (rows.size() < top + 2) rows.resize(top + 2);
  for (std::size_t l = 1; l <= top; ++l)
    if (const auto size = 4 * static_cast<std::size_t>(level(l).nodes()); rows[l].size() < size) rows[l].resize(size);
  const LevelParticles first{level(1), first_particle_, particles_};
  particles_to_nodes(first, columns, mass_, rows[0], rows[1].data(), scratch.pass);
  for (std::size_t l = 2; l <= top; ++l)
    for_level_rows(level(l).nodes(), [&](int begin, int end) {
      restrict_rows(level(l).restriction, rows[l - 1].data(), rows[l].data(), begin, end);
    });
  if (correction_.rows() > 0) correct(rows);
  for (std::size_t l = top; l >= 1; --l)
    for_level_rows(level(l).nodes(), [&](int begin, int end) {
      const double* const coarser = l == top ? nullptr : rows[l + 1].data();
      interpolate_rows(l == top ? level(l).interpolation : level(l + 1).interpolation, coarser, factor_[l - 1].data(),
                       rows[l].data(), begin, end);
    });
  nodes_to_particles(first, rows[1].data(), shares_.gamma[0], columns, scratch.pass);
}

void LevelSum::correct(std::vector<AlignedVector<double>>& rows) const {
  const std::size_t top = factor_.size();
  rows[top + 1].resize(rows[top].size());
  for_level_rows(correction_.rows(), [&](int begin, int end) {
    restrict_rows(correction_, rows[top].data(), rows[top + 1].data(), begin, end);
  });
  rows[top].swap(rows[top + 1]);
}

void LevelSum::pass_through(const FilterColumns& columns) const {
  for_level_rows(particles_, [&](int begin, int end) {
    for (int i = first_particle_ + begin; i < first_particle_ + end; ++i)
      for (int axis = 0; axis < 3; ++axis) columns.put(axis, i, columns.in[axis][i]);
  });
}

// P of a level, from the particles.
Matrix LevelSum::interpolation(int level) const {
  Matrix p(particles_, particles_);
  p.setIdentity();
  for (int l = 0; l < level; ++l)
    p = Matrix(p * matrix_of(hierarchy_.level[static_cast<std::size_t>(l)].interpolation, nodes(l + 1)));
  return p;
}

void LevelSum::add_to(std::vector<Eigen::Triplet<double>>& entries) const {
  for (int i = 0; i < particles_; ++i)
    entries.emplace_back(first_particle_ + i, first_particle_ + i, mass_(i) > 0.0 ? shares_.gamma[0] : 1.0);
  for (std::size_t l = 1; l <= factor_.size(); ++l) {
    const Matrix p = interpolation(static_cast<int>(l));
    Matrix restriction = Matrix(p.transpose()) * mass_.asDiagonal();
    if (l == factor_.size() && correction_.rows() > 0)
      restriction = Matrix(matrix_of(correction_, nodes(static_cast<int>(l))) * restriction);
    const Matrix q = Matrix(p * factor_[l - 1].asDiagonal()) * restriction;
    for (int i = 0; i < particles_; ++i)
      for (Matrix::InnerIterator e(q, i); e; ++e)
        entries.emplace_back(first_particle_ + i, first_particle_ + static_cast<int>(e.col()), e.value());
  }
}

LevelFilter::LevelFilter(const Structure& structure, const FilterOptions& options) : particles_(structure.particles()) {
  for (const Body& body : structure.body) body_.emplace_back(structure, body);
  if (options.level_shares.empty()) {
    find_level_shares(structure, options.ratio, body_);
    return;
  }
  if (options.level_shares.size() != body_.size())
    throw InputError("a filter's level shares need an entry for every body");
  for (std::size_t b = 0; b < body_.size(); ++b) body_[b].set_shares(options.level_shares[b]);
}

std::vector<LevelShares> LevelFilter::shares() const {
  std::vector<LevelShares> result;
  for (const LevelSum& body : body_) result.push_back(body.shares());
  return result;
}

std::vector<LevelTable> LevelFilter::levels() const {
  std::vector<LevelTable> result;
  for (const LevelSum& body : body_) {
    LevelTable table{{}, body.shares()};
    for (std::size_t l = 0; l < table.shares.gamma.size(); ++l) table.nodes.push_back(body.nodes(static_cast<int>(l)));
    result.push_back(std::move(table));
  }
  return result;
}

void LevelFilter::run(const FilterColumns& columns, FilterScratch& scratch) const {
  for (const LevelSum& body : body_) body.run(columns, scratch);
}

Matrix LevelFilter::matrix(const Eigen::MatrixX3d&, double) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (const LevelSum& body : body_) body.add_to(entries);
  Matrix result(particles_, particles_);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace billow::sim
