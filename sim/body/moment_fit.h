// Spring constants from what the springs of a mesh should do together: each cell of the mesh (a face, a vertex) wants
// a sum of moments, and every spring gives some to the cells that it touches.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace billow::sim {

template <int size>
struct MomentFit {
  using Moments = Eigen::Matrix<double, size, 1>;

  struct Cell {
    Moments missing = Moments::Zero();  // of what it wants, as the springs are now
    double size_of_cell = 1.0;          // its residual counts by the square over this
  };
  struct Share {
    int cell;
    Moments moments;  // that a spring of tension 1 gives
  };
  struct Spring {
    std::vector<Share> shares = {};
    double usual = 0.0;    // [N m] k L^2 as it would be without a fit
    double tension = 0.0;  // [N m] k L^2, what is sought
    double inertia = 0.0;  // second derivative of what is minimised
  };

  std::vector<Cell> cells;
  std::vector<Spring> springs;

  void give(int spring, const Share& share) {
    springs[spring].shares.push_back(share);
    springs[spring].inertia += share.moments.squaredNorm() / cells[share.cell].size_of_cell;
  }

  /// Minimises the cells' residuals, and a little of what the springs differ from the usual, over tensions >= 0: one
  /// spring after the other, each to its best. The sum is convex, so this goes to its one minimum.
  void settle() {
    for (int s = 0; s < static_cast<int>(springs.size()); ++s) set(s, springs[s].usual);
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (int s = 0; s < static_cast<int>(springs.size()); ++s)
        if (springs[s].inertia > 0.0) set(s, best(springs[s]));
  }

 private:
  // How much a spring's distance from the usual weighs against the cells'.
  static constexpr double prior = 0.01;
  static constexpr int sweeps = 60;  // what is left then changes by less than 1e-4 a sweep

  double best(const Spring& s) const {
    double slope = s.inertia * prior * (s.usual - s.tension);
    for (const Share& share : s.shares)
      slope += share.moments.dot(cells[share.cell].missing) / cells[share.cell].size_of_cell;
    return std::max(0.0, s.tension + slope / (s.inertia * (1.0 + prior)));
  }

  void set(int spring, double tension) {
    Spring& s = springs[spring];
    for (const Share& share : s.shares) cells[share.cell].missing -= (tension - s.tension) * share.moments;
    s.tension = tension;
  }
};

}  // namespace billow::sim
