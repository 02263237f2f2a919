// A graph Laplacian.
#include "sim/filter/spring_bound.h"

#include <tuple>
#include <vector>

#include "sim/body/spring_law.h"

namespace billow::sim {

Eigen::SparseMatrix<double, Eigen::RowMajor> spring_bound(const Structure& structure) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Body& body : structure.body)
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
      const int i = structure.spring(s, 0), j = structure.spring(s, 1);
      const double k = steepest_slope(body, structure.kind[static_cast<std::size_t>(s)], structure.rest_length(s),
                                      structure.stiffness(s));
      for (const auto& [row, column, value] : {std::tuple(i, i, k), {j, j, k}, {i, j, -k}, {j, i, -k}})
        entries.emplace_back(row, column, value);
    }
  Eigen::SparseMatrix<double, Eigen::RowMajor> l(structure.particles(), structure.particles());
  l.setFromTriplets(entries.begin(), entries.end());
  return l;
}

}  // namespace billow::sim
