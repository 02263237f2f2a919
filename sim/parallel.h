// How a pass over particles is shared between threads.
#pragma once

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace billow::sim {

/// Below this many particles a pass is over before a second thread has woken up.
constexpr int least_particles_for_threads = 8192;

/// Into how many parts to cut a pass over `particles`: 1, or a few per thread of the calling arena, none smaller than
/// `least_part`. Which thread does which part, and how many parts there are, never shows in a result: every output is
/// one particle's own sum, in an order that the structure fixes.
inline int parts_of(int particles, int least_part) {
  const int threads = oneapi::tbb::this_task_arena::max_concurrency();
  if (threads == 1 || particles < least_particles_for_threads) return 1;
  return std::clamp(particles / least_part, 1, 2 * threads);
}

/// Runs work(0) ... work(count - 1), on as many threads as the calling arena has.
template <class Work>
void for_each_part(int count, const Work& work) {
  if (count == 1) return work(0);
  oneapi::tbb::parallel_for(0, count, work, oneapi::tbb::simple_partitioner{});
}

}  // namespace billow::sim
