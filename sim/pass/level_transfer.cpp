// Grids by separable passes, all else row by row.
#include "sim/pass/level_transfer.h"

#include <algorithm>

namespace billow::sim {

namespace {

// Rows of a grid, each of `width` particles.
template <class Work>
void for_grid_rows(int rows, int width, const Work& work) {
  for_each_range(rows, 1, std::max(1, least_part_of_a_pass / width), work, width);
}

}  // namespace

void particles_to_nodes(const LevelParticles& at, const FilterColumns& columns, const Eigen::VectorXd& mass,
                        AlignedVector<double>& fine, double* nodes, PassScratch& scratch) {
  scratch.prepare();
  if (const auto& grid = at.level.grid)
    return for_grid_rows(grid->down.nodes(), 2 * grid->along.fine(), [&](int part, int begin, int end) {
      restrict_grid(*grid, columns, at.first_particle, mass.data(), nodes, begin, end, scratch.part(part));
    });
  fine.resize(4 * static_cast<std::size_t>(at.particles));
  for_level_rows(at.particles, [&](int begin, int end) {
    put_momenta(columns, at.first_particle, mass.data(), fine.data(), begin, end);
  });
  for_level_rows(at.level.nodes(),
                 [&](int begin, int end) { restrict_rows(at.level.restriction, fine.data(), nodes, begin, end); });
}

void nodes_to_particles(const LevelParticles& at, const double* nodes, double share, const FilterColumns& columns,
                        PassScratch& scratch) {
  scratch.prepare();
  const SparseRows& interpolation = at.level.interpolation;
  if (const auto& grid = at.level.grid)
    return for_grid_rows(grid->down.fine(), grid->along.fine(), [&](int part, int begin, int end) {
      put_interpolated_grid(*grid, interpolation, nodes, share, columns, at.first_particle, begin, end,
                            scratch.part(part));
    });
  for_level_rows(at.particles, [&](int begin, int end) {
    put_interpolated(interpolation, nodes, share, columns, at.first_particle, begin, end);
  });
}

}  // namespace billow::sim
