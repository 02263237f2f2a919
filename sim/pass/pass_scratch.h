// The memory that vector passes work in. It belongs to whoever takes the passes, and is used again by the next one.
#pragma once

#include <cstddef>
#include <vector>

#include "base/aligned.h"
#include "base/parallel.h"

namespace billow::sim {

/// The last forces of one stride's springs, [position % length], each axis in a row of its own. The first vector is
/// repeated behind the last, so that what is read from anywhere is contiguous.
struct BandRing {
  double* row[3];
  std::ptrdiff_t length, write, read, stride;
  double stiffness, damping;
};

/// What one part of a pass needs, on cache lines of its own.
struct alignas(64) PartScratch {
  AlignedVector<double> ring;                // forces that wait (bands), particles around the sweep (slices)
  AlignedVector<double> position, velocity;  // a body's last particles with zeros behind them
  AlignedVector<double> rows;                // particles that a filter reads
  std::vector<BandRing> rings;               // one for each stride
};

/// Room for the passes of one caller: two that run at the same time need two.
class PassScratch {
 public:
  /// Before a pass: room for as many parts as the calling arena's threads can make of it.
  void prepare() {
    const auto parts = static_cast<std::size_t>(most_parts());
    if (part_.size() < parts) part_.resize(parts);
  }
  PartScratch& part(int number) { return part_[static_cast<std::size_t>(number)]; }

 private:
  std::vector<PartScratch> part_;
};

}  // namespace billow::sim
