// K x from per-spring blocks, and the same matrix assembled.
#include "sim/stiffness.h"

#include "sim/spring_law.h"

namespace billow::sim {

StiffnessMatrix::StiffnessMatrix(const Structure& structure)
    : structure_(structure),
      diagonal_(Eigen::VectorXd::Zero(structure.particles())),
      direction_(Eigen::MatrixX3d::Zero(structure.springs(), 3)),
      isotropic_(Eigen::VectorXd::Zero(structure.springs())),
      along_(Eigen::VectorXd::Zero(structure.springs())) {}

void StiffnessMatrix::add_block(int spring, const Eigen::Vector3d& direction, double isotropic, double along) {
  direction_.row(spring) = direction;
  isotropic_(spring) += isotropic;
  along_(spring) += along;
  only_diagonal_ = only_diagonal_ && isotropic_(spring) == 0.0 && along_(spring) == 0.0;
}

void StiffnessMatrix::add_scaled(const StiffnessMatrix& other, double weight) {
  diagonal_ += weight * other.diagonal_;
  direction_ = other.direction_;
  isotropic_ += weight * other.isotropic_;
  along_ += weight * other.along_;
  only_diagonal_ = only_diagonal_ && other.only_diagonal_;
}

void StiffnessMatrix::multiply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& out) const {
  out = diagonal_.asDiagonal() * x;
  if (only_diagonal_) return;
  const int* first = structure_.spring.col(0).data();
  const int* second = structure_.spring.col(1).data();
  const double *xx = x.col(0).data(), *xy = x.col(1).data(), *xz = x.col(2).data();
  const double *ux = direction_.col(0).data(), *uy = direction_.col(1).data(), *uz = direction_.col(2).data();
  double *ox = out.col(0).data(), *oy = out.col(1).data(), *oz = out.col(2).data();
  for (int s = 0; s < structure_.springs(); ++s) {
    const int i = first[s], j = second[s];
    const double dx = xx[i] - xx[j], dy = xy[i] - xy[j], dz = xz[i] - xz[j];
    const double a = isotropic_[s], b = along_[s] * (ux[s] * dx + uy[s] * dy + uz[s] * dz);
    const double bx = a * dx + b * ux[s], by = a * dy + b * uy[s], bz = a * dz + b * uz[s];
    ox[i] += bx, oy[i] += by, oz[i] += bz;
    ox[j] -= bx, oy[j] -= by, oz[j] -= bz;
  }
}

namespace {

Eigen::Matrix3d block(const Eigen::Vector3d& direction, double isotropic, double along) {
  return isotropic * Eigen::Matrix3d::Identity() + along * direction * direction.transpose();
}

}  // namespace

Eigen::MatrixX3d StiffnessMatrix::diagonal_blocks() const {
  Eigen::MatrixX3d blocks = Eigen::MatrixX3d::Zero(3 * structure_.particles(), 3);
  for (int i = 0; i < structure_.particles(); ++i)
    blocks.middleRows<3>(3 * i) = diagonal_(i) * Eigen::Matrix3d::Identity();
  for (int s = 0; s < structure_.springs(); ++s) {
    const Eigen::Matrix3d b = block(direction_.row(s), isotropic_(s), along_(s));
    blocks.middleRows<3>(3 * structure_.spring(s, 0)) += b;
    blocks.middleRows<3>(3 * structure_.spring(s, 1)) += b;
  }
  return blocks;
}

Eigen::SparseMatrix<double> StiffnessMatrix::assemble(bool eliminate_pins) const {
  const int n = structure_.particles();
  const Eigen::MatrixX3d diagonal = diagonal_blocks();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * n + 18 * structure_.springs());
  const auto add = [&](int i, int j, const Eigen::Matrix3d& b) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) entries.emplace_back(3 * i + r, 3 * j + c, b(r, c));
  };
  const auto eliminated = [&](int i) { return eliminate_pins && structure_.pinned(i); };
  for (int i = 0; i < n; ++i)
    add(i, i,
        eliminated(i) ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : Eigen::Matrix3d(diagonal.middleRows<3>(3 * i)));
  for (int s = 0; s < structure_.springs(); ++s) {
    const int i = structure_.spring(s, 0), j = structure_.spring(s, 1);
    if (eliminated(i) || eliminated(j)) continue;
    const Eigen::Matrix3d b = -block(direction_.row(s), isotropic_(s), along_(s));
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
    diagonal(i) += isotropic_(s);
    diagonal(j) += isotropic_(s);
    if (eliminate_pins && (structure_.pinned(i) || structure_.pinned(j))) continue;
    entries.emplace_back(i, j, -isotropic_(s));
    entries.emplace_back(j, i, -isotropic_(s));
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
