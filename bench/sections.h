// The parts of the benchmark. Each registers its benchmarks with Google Benchmark and says which ratios of them matter.
#pragma once

#include <string>
#include <vector>

namespace billow::bench {

/// A ratio of two benchmarks' nanoseconds per spring, and what it should be.
struct Target {
  std::string what;                   // as the table says it
  std::string measured, compared_to;  // benchmarks, by name
  double limit = 0.0;
  bool at_least = false;  // the ratio should be at least the limit; else at most
  bool by_clock = false;  // else by processor time
};

using Targets = std::vector<Target>;

/// The arithmetic of the springs on arrays in the L1 cache: what no pass over a structure can beat.
Targets add_ceiling();
/// Force pass, filter pass, whole filtered steps and iterations of the linear solve, by size, kind of mesh and threads.
Targets add_passes();
/// Bullet's soft body on the same grid. Not there without Bullet.
Targets add_bullet();

/// Names that targets of several sections refer to.
inline constexpr const char* ceiling_name = "ceiling";
std::string pass_name(const std::string& pass, const std::string& cloth, int threads);

}  // namespace billow::bench
