// K x from per-spring blocks, and the same matrix assembled.
#include "sim/stiffness.h"

#include "sim/spring_law.h"

namespace billow::sim {

StiffnessMatrix::StiffnessMatrix(const Structure& structure)
    : structure_(structure),
      plan_(std::make_shared<const ProductPlan>(structure)),
      diagonal_(Eigen::VectorXd::Zero(structure.particles())),
      direction_(Eigen::MatrixX3d::Zero(plan_->slots(), 3)),
      isotropic_(Eigen::VectorXd::Zero(plan_->slots())),
      along_(Eigen::VectorXd::Zero(plan_->slots())) {}

void StiffnessMatrix::add_block(int spring, const Eigen::Vector3d& direction, double isotropic, double along) {
  const int k = plan_->slot[spring];
  direction_.row(k) = direction;
  isotropic_(k) += isotropic;
  along_(k) += along;
  only_diagonal_ = only_diagonal_ && isotropic_(k) == 0.0 && along_(k) == 0.0;
}

void StiffnessMatrix::set_zero() {
  diagonal_.setZero();
  isotropic_.setZero();
  along_.setZero();
  only_diagonal_ = true;
}

void StiffnessMatrix::scale(double weight) {
  diagonal_ *= weight;
  isotropic_ *= weight;
  along_ *= weight;
}

void StiffnessMatrix::add_scaled(const StiffnessMatrix& other, double weight) {
  diagonal_ += weight * other.diagonal_;
  if (other.only_diagonal_) return;
  direction_ = other.direction_;
  isotropic_ += weight * other.isotropic_;
  along_ += weight * other.along_;
  only_diagonal_ = false;
}

void StiffnessMatrix::multiply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& out) const {
  out = diagonal_.asDiagonal() * x;
  if (only_diagonal_) return;
  add_product(*plan_, columns(), x, out);
}

BlockColumns StiffnessMatrix::columns() const {
  return {direction_.col(0).data(), direction_.col(1).data(), direction_.col(2).data(), isotropic_.data(),
          along_.data()};
}

void StiffnessMatrix::diagonal_blocks(Eigen::MatrixX3d& straight, Eigen::MatrixX3d& mixed) const {
  straight = diagonal_.replicate<1, 3>();
  mixed.setZero(straight.rows(), 3);
  if (!only_diagonal_) add_diagonal_blocks(*plan_, columns(), straight, mixed);
}

namespace {

Eigen::Matrix3d block(const Eigen::Vector3d& direction, double isotropic, double along) {
  return isotropic * Eigen::Matrix3d::Identity() + along * direction * direction.transpose();
}

Eigen::Matrix3d symmetric(const Eigen::RowVector3d& straight, const Eigen::RowVector3d& mixed) {
  Eigen::Matrix3d matrix = straight.asDiagonal();
  matrix(0, 1) = matrix(1, 0) = mixed(0);
  matrix(0, 2) = matrix(2, 0) = mixed(1);
  matrix(1, 2) = matrix(2, 1) = mixed(2);
  return matrix;
}

}  // namespace

Eigen::SparseMatrix<double> StiffnessMatrix::assemble(bool eliminate_pins) const {
  const int n = structure_.particles();
  Eigen::MatrixX3d straight, mixed;
  diagonal_blocks(straight, mixed);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * n + 18 * structure_.springs());
  const auto add = [&](int i, int j, const Eigen::Matrix3d& b) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) entries.emplace_back(3 * i + r, 3 * j + c, b(r, c));
  };
  const auto eliminated = [&](int i) { return eliminate_pins && structure_.pinned(i); };
  for (int i = 0; i < n; ++i)
    add(i, i, eliminated(i) ? Eigen::Matrix3d::Identity().eval() : symmetric(straight.row(i), mixed.row(i)));
  for (int s = 0; s < structure_.springs(); ++s) {
    const int i = structure_.spring(s, 0), j = structure_.spring(s, 1), k = plan_->slot[s];
    if (eliminated(i) || eliminated(j)) continue;
    const Eigen::Matrix3d b = -block(direction_.row(k), isotropic_(k), along_(k));
    add(i, j, b);
    add(j, i, b);
  }
  Eigen::SparseMatrix<double> matrix(3 * n, 3 * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::SparseMatrix<double> StiffnessMatrix::assemble_one_axis(bool eliminate_pins) const {
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

namespace {

/// How a spring's stiffness and damping enter: along its rest direction, or in all directions.
enum class SpringReach { along, all };

Linearisation linearised(const Structure& structure, SpringReach reach) {
  Linearisation result{StiffnessMatrix(structure), StiffnessMatrix(structure)};
  const auto add = [&](StiffnessMatrix& matrix, int s, const Eigen::Vector3d& u, double value, bool isotropic) {
    matrix.add_block(s, u, isotropic ? value : 0.0, isotropic ? 0.0 : value);
  };
  for (const Body& body : structure.body) {
    const bool all = reach == SpringReach::all;
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
      const Eigen::RowVector3d d =
          structure.rest_position.row(structure.spring(s, 1)) - structure.rest_position.row(structure.spring(s, 0));
      const Eigen::Vector3d u = d.normalized();
      const double k = structure.stiffness(s);
      add(result.stiffness, s, u, all ? steepest_slope(body, structure.kind[s], structure.rest_length(s), k) : k, all);
      add(result.damping, s, u, structure.damping(s), all || body.damping_model == DampingModel::spring);
    }
    for (int i = body.first_particle; i < body.first_particle + body.particles; ++i)
      result.damping.add_diagonal(i, body.friction);
  }
  return result;
}

}  // namespace

Linearisation linearise_at_rest(const Structure& structure) { return linearised(structure, SpringReach::along); }

Linearisation linearise_any_shape(const Structure& structure) { return linearised(structure, SpringReach::all); }

}  // namespace billow::sim
