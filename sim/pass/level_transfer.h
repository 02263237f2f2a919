// Between a body's particles and the nodes of a level above them, on all threads, by whichever passes suit the level.
#pragma once

#include <Eigen/Core>

#include "base/aligned.h"
#include "base/parallel.h"
#include "sim/pass/level_pass.h"

namespace billow::sim {

/// work(begin, end) over [0, rows) in parts that are worth a thread's while.
template <class Work>
void for_level_rows(int rows, const Work& work) {
  for_each_range(rows, 1, least_part_of_a_pass, [&](int, int begin, int end) { work(begin, end); });
}

/// A body's particles below a level that is interpolated to them.
struct LevelParticles {
  const NodeLevel& level;
  int first_particle = 0, particles = 0;
};

/// nodes (rows of four) = P^T mass x, x the columns' field. `fine` is for the particles' own rows, where such are
/// needed.
void particles_to_nodes(const LevelParticles& at, const FilterColumns& columns, const Eigen::VectorXd& mass,
                        AlignedVector<double>& fine, double* nodes, PassScratch& scratch);

/// To the columns' `out`: share x in + P nodes; `in` itself for pinned particles.
void nodes_to_particles(const LevelParticles& at, const double* nodes, double share, const FilterColumns& columns,
                        PassScratch& scratch);

}  // namespace billow::sim
