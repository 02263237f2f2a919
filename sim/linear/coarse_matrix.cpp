// Summed spring by spring into the blocks of pairs of nodes.
#include "sim/linear/coarse_matrix.h"

#include <algorithm>

namespace billow::sim {

CoarseMatrix::CoarseMatrix(const Structure& structure, const Body& body, const NodeLevel& level)
    : first_particle_(body.first_particle),
      particles_(body.particles),
      first_spring_(body.first_spring),
      interpolation_(level.interpolation) {
  for (int node = 0; node < level.nodes(); ++node)
    lonely_.push_back(level.restriction.first[static_cast<std::size_t>(node)] ==
                      level.restriction.first[static_cast<std::size_t>(node) + 1]);
  std::vector<int> pair_of(lonely_.size() * lonely_.size(), -1);
  std::vector<Node> joined;
  for (int i = 0; i < particles_; ++i) {
    joined.clear();
    add_nodes(i, 1.0, joined);
    add_shares(joined, pair_of, of_particle_);
  }
  for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
    joined.clear();
    add_nodes(structure.spring(s, 0) - first_particle_, 1.0, joined);
    add_nodes(structure.spring(s, 1) - first_particle_, -1.0, joined);
    add_shares(joined, pair_of, of_spring_);
  }
  block_.resize(6, static_cast<Eigen::Index>(pair_.size()));
}

void CoarseMatrix::add_nodes(int particle, double weight, std::vector<Node>& nodes) const {
  const auto first = static_cast<std::size_t>(interpolation_.first[static_cast<std::size_t>(particle)]);
  const auto last = static_cast<std::size_t>(interpolation_.first[static_cast<std::size_t>(particle) + 1]);
  for (std::size_t e = first; e < last; ++e) {
    const auto same = [&](const Node& node) { return node.number == interpolation_.column[e]; };
    const auto found = std::find_if(nodes.begin(), nodes.end(), same);
    if (found == nodes.end())
      nodes.push_back({interpolation_.column[e], weight * interpolation_.weight[e]});
    else
      found->weight += weight * interpolation_.weight[e];
  }
}

// The square of the sum of weight x node.
void CoarseMatrix::add_shares(const std::vector<Node>& nodes, std::vector<int>& pair_of, Shares& shares) {
  for (const Node& a : nodes)
    for (const Node& b : nodes) {
      if (a.number < b.number || a.weight * b.weight == 0.0) continue;
      int& pair = pair_of[static_cast<std::size_t>(a.number) * lonely_.size() + static_cast<std::size_t>(b.number)];
      if (pair < 0) {
        pair = static_cast<int>(pair_.size());
        pair_.emplace_back(a.number, b.number);
      }
      shares.share.push_back({pair, a.weight * b.weight});
    }
  shares.first.push_back(static_cast<int>(shares.share.size()));
}

const Eigen::MatrixXd& CoarseMatrix::sum(const StiffnessMatrix& matrix) {
  block_.setZero();
  sum_diagonal(matrix);
  sum_springs(matrix);
  put_pairs();
  add_blocks(matrix);
  return matrix_;
}

void CoarseMatrix::sum_diagonal(const StiffnessMatrix& matrix) {
  for (int i = 0; i < particles_; ++i) {
    const double value = matrix.diagonal()(first_particle_ + i);
    const auto last = static_cast<std::size_t>(of_particle_.first[static_cast<std::size_t>(i) + 1]);
    for (auto e = static_cast<std::size_t>(of_particle_.first[static_cast<std::size_t>(i)]); e < last; ++e)
      block_.col(of_particle_.share[e].pair).head<3>().array() += of_particle_.share[e].weight * value;
  }
}

void CoarseMatrix::sum_springs(const StiffnessMatrix& matrix) {
  const auto springs = static_cast<int>(of_spring_.first.size()) - 1;
  for (int s = 0; s < springs; ++s) {
    const Eigen::Matrix3d b = matrix.spring_block(first_spring_ + s);
    const Eigen::Matrix<double, 6, 1> six(b(0, 0), b(1, 1), b(2, 2), b(0, 1), b(0, 2), b(1, 2));
    const auto last = static_cast<std::size_t>(of_spring_.first[static_cast<std::size_t>(s) + 1]);
    for (auto e = static_cast<std::size_t>(of_spring_.first[static_cast<std::size_t>(s)]); e < last; ++e)
      block_.col(of_spring_.share[e].pair) += of_spring_.share[e].weight * six;
  }
}

void CoarseMatrix::put_pairs() {
  matrix_.setZero(3 * nodes(), 3 * nodes());
  for (std::size_t p = 0; p < pair_.size(); ++p) {
    const auto b = block_.col(static_cast<Eigen::Index>(p));
    auto place = matrix_.block<3, 3>(3 * pair_[p](0), 3 * pair_[p](1));
    place << b(0), b(3), b(4), b(3), b(1), b(5), b(4), b(5), b(2);
  }
  for (int node = 0; node < nodes(); ++node)
    if (lonely_[static_cast<std::size_t>(node)]) matrix_.block<3, 3>(3 * node, 3 * node).setIdentity();
}

void CoarseMatrix::add_blocks(const StiffnessMatrix& matrix) {
  std::vector<Node> rows, columns;
  for (const auto& [i, j, value] : matrix.blocks()) {
    const int r = i - first_particle_, c = j - first_particle_;
    if (r < 0 || r >= particles_ || c < 0 || c >= particles_) continue;
    rows.clear(), columns.clear();
    add_nodes(r, 1.0, rows);
    add_nodes(c, 1.0, columns);
    for (const Node& a : rows)
      for (const Node& b : columns) matrix_.block<3, 3>(3 * a.number, 3 * b.number) += a.weight * b.weight * value;
  }
}

}  // namespace billow::sim
