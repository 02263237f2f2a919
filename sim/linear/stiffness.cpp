// K x from blocks, and the same matrix assembled.
#include "sim/linear/stiffness.h"

#include <algorithm>
#include <stdexcept>

namespace billow::sim {

StiffnessMatrix::StiffnessMatrix(const Structure& structure)
    : structure_(structure),
      plan_(std::make_shared<const ProductPlan>(structure)),
      diagonal_(Eigen::VectorXd::Zero(structure.particles())),
      direction_(Eigen::MatrixX3d::Zero(plan_->slots(), 3)),
      isotropic_(Eigen::VectorXd::Zero(plan_->slots())),
      along_(Eigen::VectorXd::Zero(plan_->slots())) {}

void StiffnessMatrix::add_spring(int spring, const Eigen::Vector3d& direction, double isotropic, double along) {
  const int k = plan_->slot[spring];
  direction_.row(k) = direction;
  isotropic_(k) += isotropic;
  along_(k) += along;
  springless_ = springless_ && isotropic_(k) == 0.0 && along_(k) == 0.0;
}

void StiffnessMatrix::add_block(int i, int j, const Eigen::Matrix3d& block) { block_.push_back({i, j, block}); }

void StiffnessMatrix::add_pair(int i, int j, const Eigen::Matrix3d& block) {
  add_block(i, i, block);
  add_block(j, j, block);
  add_block(i, j, -block);
  add_block(j, i, -block);
}

void StiffnessMatrix::set_zero() {
  diagonal_.setZero();
  isotropic_.setZero();
  along_.setZero();
  springless_ = true;
  block_.clear();
}

bool StiffnessMatrix::is_zero() const {
  const auto zero = [](const Block& block) { return (block.value.array() == 0.0).all(); };
  return springless_ && (diagonal_.array() == 0.0).all() && std::all_of(block_.begin(), block_.end(), zero);
}

void StiffnessMatrix::scale(double weight) {
  diagonal_ *= weight;
  isotropic_ *= weight;
  along_ *= weight;
  for (Block& block : block_) block.value *= weight;
}

void StiffnessMatrix::add_scaled(const StiffnessMatrix& other, double weight) {
  diagonal_ += weight * other.diagonal_;
  for (const Block& block : other.block_) add_block(block.i, block.j, weight * block.value);
  if (other.springless_) return;
  direction_ = other.direction_;
  isotropic_ += weight * other.isotropic_;
  along_ += weight * other.along_;
  springless_ = false;
}

void StiffnessMatrix::multiply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& out) const {
  out = diagonal_.asDiagonal() * x;
  if (!springless_) add_product(*plan_, columns(), x, out);
  for (const auto& [i, j, block] : block_) out.row(i) += x.row(j) * block.transpose();
}

BlockColumns StiffnessMatrix::columns() const {
  return {direction_.col(0).data(), direction_.col(1).data(), direction_.col(2).data(), isotropic_.data(),
          along_.data()};
}

void StiffnessMatrix::diagonal_without_blocks(Eigen::MatrixX3d& straight, Eigen::MatrixX3d& mixed) const {
  straight = diagonal_.replicate<1, 3>();
  mixed.setZero(straight.rows(), 3);
  if (!springless_) add_diagonal_blocks(*plan_, columns(), straight, mixed);
}

void StiffnessMatrix::diagonal_blocks(Eigen::MatrixX3d& straight, Eigen::MatrixX3d& mixed) const {
  diagonal_without_blocks(straight, mixed);
  for (const auto& [i, j, block] : block_) {
    if (i != j) continue;
    straight.row(i) += block.diagonal().transpose();
    const Eigen::Matrix3d twice = block + block.transpose();
    mixed.row(i) += 0.5 * Eigen::RowVector3d(twice(0, 1), twice(0, 2), twice(1, 2));
  }
}

namespace {

Eigen::Matrix3d symmetric(const Eigen::RowVector3d& straight, const Eigen::RowVector3d& mixed) {
  Eigen::Matrix3d matrix = straight.asDiagonal();
  matrix(0, 1) = matrix(1, 0) = mixed(0);
  matrix(0, 2) = matrix(2, 0) = mixed(1);
  matrix(1, 2) = matrix(2, 1) = mixed(2);
  return matrix;
}

}  // namespace

Eigen::Matrix3d StiffnessMatrix::spring_block(int spring) const {
  const int k = plan_->slot[spring];
  const Eigen::Vector3d direction = direction_.row(k);
  return isotropic_(k) * Eigen::Matrix3d::Identity() + along_(k) * direction * direction.transpose();
}

// What springs and diagonal come to at (i, i) is put at once; the diagonal blocks' share of it is added like all
// others.
Eigen::SparseMatrix<double> StiffnessMatrix::assemble(bool eliminate_pins) const {
  const int n = structure_.particles();
  Eigen::MatrixX3d straight, mixed;
  diagonal_without_blocks(straight, mixed);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * (n + 2 * structure_.springs() + block_.size()));
  const auto add = [&](int i, int j, const Eigen::Matrix3d& b) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) entries.emplace_back(3 * i + r, 3 * j + c, b(r, c));
  };
  const auto eliminated = [&](int i) { return eliminate_pins && structure_.pinned(i); };
  for (int i = 0; i < n; ++i)
    add(i, i, eliminated(i) ? Eigen::Matrix3d::Identity().eval() : symmetric(straight.row(i), mixed.row(i)));
  for (int s = 0; s < structure_.springs(); ++s) {
    const int i = structure_.spring(s, 0), j = structure_.spring(s, 1);
    if (eliminated(i) || eliminated(j)) continue;
    const Eigen::Matrix3d b = -spring_block(s);
    add(i, j, b);
    add(j, i, b);
  }
  for (const auto& [i, j, value] : block_)
    if (!eliminated(i) && !eliminated(j)) add(i, j, value);
  Eigen::SparseMatrix<double> matrix(3 * n, 3 * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::SparseMatrix<double> StiffnessMatrix::assemble_one_axis(bool eliminate_pins) const {
  if (!block_.empty())
    throw std::logic_error("a matrix with blocks between particles does not act on every axis alike");
  const int n = structure_.particles();
  Eigen::VectorXd diagonal = diagonal_;
  std::vector<Eigen::Triplet<double>> entries;
  for (int s = 0; s < structure_.springs(); ++s) {
    const int i = structure_.spring(s, 0), j = structure_.spring(s, 1);
    const double a = isotropic_(plan_->slot[s]);
    diagonal(i) += a;
    diagonal(j) += a;
    if (eliminate_pins && (structure_.pinned(i) || structure_.pinned(j))) continue;
    entries.emplace_back(i, j, -a);
    entries.emplace_back(j, i, -a);
  }
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, eliminate_pins && structure_.pinned(i) ? 1.0 : diagonal(i));
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace billow::sim
