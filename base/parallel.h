// How a pass over particles is shared between threads.
#pragma once

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstdint>

namespace billow {

/// Below this many particles a pass is over before a second thread has woken up.
constexpr int least_particles_for_threads = 8192;

/// A pass gives no thread fewer particles than this: they are not worth its while.
constexpr int least_part_of_a_pass = 2048;

/// The most parts into which a pass is ever cut on the calling arena's threads.
inline int most_parts() { return 2 * oneapi::tbb::this_task_arena::max_concurrency(); }

/// Into how many parts to cut a pass over `particles`: 1, or a few per thread of the calling arena, none smaller than
/// `least_part`. Which thread does which part, and how many parts there are, never shows in a result: every output is
/// one particle's own sum, in an order that the structure fixes.
inline int parts_of(int particles, int least_part) {
  const int threads = oneapi::tbb::this_task_arena::max_concurrency();
  if (threads == 1 || particles < least_particles_for_threads) return 1;
  const int parts = std::clamp(particles / least_part, 1, most_parts());
  return parts > threads ? parts / threads * threads : parts;  // else a thread would wait for another's second part
}

/// Runs work(0) ... work(parts - 1) on the calling arena's threads. While it waits, the caller takes no other task:
/// that could be a whole other simulation, which would be waited for.
template <class Work>
void run_isolated(int parts, const Work& work) {
  oneapi::tbb::this_task_arena::isolate(
      [&] { oneapi::tbb::parallel_for(0, parts, work, oneapi::tbb::simple_partitioner{}); });
}

/// Runs work(part, begin, end) over [0, count) in parts that begin at multiples of `unit`, numbered from 0, fewer than
/// most_parts(): no two run at the same time with the same number. count, unit and least_part are in things of `lanes`
/// particles each.
template <class Work>
void for_each_range(int count, int unit, int least_part, const Work& work, int lanes = 1) {
  const int parts = parts_of(lanes * count, lanes * least_part);
  if (parts == 1) return work(0, 0, count);
  const auto begin = [&](int part) {
    if (part == parts) return count;
    return static_cast<int>(std::int64_t{count} * part / parts / unit * unit);
  };
  run_isolated(parts, [&](int part) { work(part, begin(part), begin(part + 1)); });
}

}  // namespace billow
