// K x at the machine's vector width.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/body/structure.h"

namespace billow::sim {

/// The springs of a structure in an order that suits vectors: runs of neighbours, slot k of a run joining particle
/// first + k with second + k, so that a vector of springs reads and writes whole vectors of particles. Slots without a
/// spring, whose blocks stay zero, carry runs over gaps such as the ends of a grid's rows; regular grids are all runs.
/// What fits no run follows, in the order of its particles.
struct ProductPlan {
  /// Slots side by side; a loose piece is no run and looks its particles up.
  struct Piece {
    static constexpr int max_slots = 256;  // the product's buffers stay in the nearest cache
    int begin = 0, count = 0;
    int first = 0, second = 0;  // particles of its first slot
    bool loose = false;
  };

  explicit ProductPlan(const Structure& structure);

  int slots() const { return static_cast<int>(first.size()); }

  std::vector<int> slot;           // (m) by spring: its place in this order
  std::vector<int> first, second;  // (slots) particles
  std::vector<Piece> pieces;       // all slots, in order

 private:
  void lay_run(const Structure& structure, const int* spring, int count);
  void lay_loose(const Structure& structure, const std::vector<int>& spring);
  void add_pieces(int begin, bool loose);
};

/// What a spring's block B = a I + b u u^T is made of, by slot: raw columns of a number each.
struct BlockColumns {
  const double *ux, *uy, *uz, *isotropic, *along;
};

/// out (n x 3) += K x: for every spring i-j, B (x_i - x_j) onto i and its negative onto j, piece by piece. No sum
/// depends on the width of the vectors, so neither do the bits.
void add_product(const ProductPlan& plan, const BlockColumns& blocks, const Eigen::MatrixX3d& x, Eigen::MatrixX3d& out);

/// The 3 x 3 blocks on the diagonal: to `straight` (n x 3) their xx, yy, zz, to `mixed` (n x 3) their xy, xz, yz are
/// added.
void add_diagonal_blocks(const ProductPlan& plan, const BlockColumns& blocks, Eigen::MatrixX3d& straight,
                         Eigen::MatrixX3d& mixed);

}  // namespace billow::sim
