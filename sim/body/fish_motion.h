// What a fish's muscles do over time: the swim and turn controllers of Tu & Terzopoulos 1994, keyed.
#pragma once

#include <vector>

#include "sim/body/fish.h"

namespace billow::sim {

/// The controllers from one moment on.
struct MotionKey {
  double time = 0.0;  // [s]
  double swim = 0.0;  // [0, 1]  how far the swimming muscles contract, as a share of their rest length
  double turn = 0.0;  // [-1, 1] how far the turning muscles contract: positive on the left, and the fish turns left
  double frequency = 1.0;  // [1/s]   of the tail beat, > 0
};

struct MotionOptions {
  std::vector<MotionKey> keys;  // ascending in time, at least `transition` apart; none: the muscles stay still
  double transition = 0.5;      // [s]   over which a key takes hold
  double lag = 1.2;             // [rad] by which the last segment follows the one before it
  double phase = 0.0;           // [rad] of the tail beat at the first key
};

/// The contraction of every muscle at any time. A contraction of c makes a muscle's rest length L (1 - c).
class FishMotion {
 public:
  /// Throws InputError on keys that are out of order or nearer to each other than the transition.
  explicit FishMotion(MotionOptions options);

  /// In [0, 1]. The middle and last segment swim, (1 + sin) / 2 on the left and (1 - sin) / 2 on the right; the first
  /// and middle one turn.
  double contraction(int segment, Side side, double time) const;
  /// What contraction() never exceeds at any time, in [0, 1].
  double largest_contraction(int segment, Side side) const;

 private:
  struct Drive {
    double swim, turn, angle;  // amplitudes, and the phase of the tail beat [rad]
  };
  Drive drive(double time) const;

  MotionOptions options_;
  std::vector<double> angle_;  // [rad] of the tail beat at each key
};

}  // namespace billow::sim
