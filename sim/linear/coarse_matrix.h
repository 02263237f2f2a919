// A matrix as it acts on motions that few nodes describe.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/levels/level_hierarchy.h"
#include "sim/linear/stiffness.h"

namespace billow::sim {

/// P^T A P for ever new A, P being a level's interpolation to a body's particles: which nodes a spring joins, and how
/// much of its block each pair of them gets, is the same for every state.
class CoarseMatrix {
 public:
  CoarseMatrix(const Structure& structure, const Body& body, const NodeLevel& level);
  /// The lower triangle (3 nodes x 3 nodes), node-major; the identity at nodes that no particle follows. Positive
  /// definite if A is, whatever joins the body to others.
  const Eigen::MatrixXd& sum(const StiffnessMatrix& matrix);

 private:
  /// A share of something that goes to a pair of nodes.
  struct Share {
    int pair = 0;
    double weight = 0.0;
  };
  struct Shares {
    std::vector<int> first{0};
    std::vector<Share> share;
  };
  struct Node {
    int number = 0;
    double weight = 0.0;
  };
  int nodes() const { return static_cast<int>(lonely_.size()); }
  void add_nodes(int particle, double weight, std::vector<Node>& nodes) const;
  void add_shares(const std::vector<Node>& nodes, std::vector<int>& pair_of, Shares& shares);
  void sum_diagonal(const StiffnessMatrix& matrix);
  void sum_springs(const StiffnessMatrix& matrix);
  void put_pairs();
  void add_blocks(const StiffnessMatrix& matrix);

  int first_particle_, particles_, first_spring_;
  SparseRows interpolation_;
  std::vector<char> lonely_;           // of each node: whether no particle follows it
  std::vector<Eigen::Vector2i> pair_;  // nodes that a spring joins or that a particle follows, the larger one first
  Shares of_particle_, of_spring_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> block_;  // (pairs) xx, yy, zz, xy, xz, yz
  Eigen::MatrixXd matrix_;
};

}  // namespace billow::sim
