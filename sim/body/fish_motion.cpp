// Keys -> contractions. Between keys everything is constant but the beat; a key's values blend in by the smoothstep
// s(x) = x^2 (3 - 2 x), and the beat's angle is the integral of the blended frequency, so that nothing jumps.
#include "sim/body/fish_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"

namespace billow::sim {
namespace {

double smoothstep(double x) { return x * x * (3.0 - 2.0 * x); }
// Its integral from 0, which is 1/2 at 1.
double smoothstep_integral(double x) { return x * x * x * (1.0 - 0.5 * x); }

double blend(double from, double to, double share) { return from + share * (to - from); }

void check(const MotionOptions& options) {
  for (std::size_t k = 1; k < options.keys.size(); ++k)
    if (options.keys[k].time - options.keys[k - 1].time < options.transition)
      throw InputError("key " + std::to_string(k) + " of the motion comes before the transition to key " +
                       std::to_string(k - 1) + " is over");
}

// Radians of beat in `elapsed` seconds after a key that changes the frequency from `before` to `after`.
double beat(double before, double after, double elapsed, double transition) {
  const double x = transition > 0.0 ? std::min(elapsed / transition, 1.0) : 1.0;
  const double blended = transition * (before * x + (after - before) * smoothstep_integral(x));
  return 2.0 * std::numbers::pi * (blended + after * std::max(elapsed - transition, 0.0));
}

}  // namespace

FishMotion::FishMotion(MotionOptions options) : options_(std::move(options)) {
  check(options_);
  const std::vector<MotionKey>& keys = options_.keys;
  if (!keys.empty()) angle_.push_back(options_.phase);
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const double before = keys[k >= 2 ? k - 2 : 0].frequency;
    angle_.push_back(angle_.back() +
                     beat(before, keys[k - 1].frequency, keys[k].time - keys[k - 1].time, options_.transition));
  }
}

FishMotion::Drive FishMotion::drive(double time) const {
  const std::vector<MotionKey>& keys = options_.keys;
  const auto later =
      std::upper_bound(keys.begin(), keys.end(), time, [](double t, const MotionKey& key) { return t < key.time; });
  if (later == keys.begin()) return {0.0, 0.0, options_.phase};
  const auto k = static_cast<std::size_t>(later - keys.begin()) - 1;
  const MotionKey still{0.0, 0.0, 0.0, keys.front().frequency};
  const MotionKey& from = k > 0 ? keys[k - 1] : still;
  const MotionKey& to = keys[k];
  const double elapsed = time - to.time;
  const double x = options_.transition > 0.0 ? std::min(elapsed / options_.transition, 1.0) : 1.0;
  const double share = smoothstep(x);
  return {blend(from.swim, to.swim, share), blend(from.turn, to.turn, share),
          angle_[k] + beat(from.frequency, to.frequency, elapsed, options_.transition)};
}

namespace {

double handed(Side side) { return side == Side::left ? 1.0 : -1.0; }
bool swims(int segment) { return segment >= 1; }
bool turns(int segment) { return segment <= 1; }

}  // namespace

double FishMotion::contraction(int segment, Side side, double time) const {
  const Drive now = drive(time);
  const double angle = now.angle - options_.lag * (segment - 1);
  const double swim = swims(segment) ? 0.5 * now.swim * (1.0 + handed(side) * std::sin(angle)) : 0.0;
  const double turn = turns(segment) ? std::max(handed(side) * now.turn, 0.0) : 0.0;
  return std::min(swim + turn, 1.0);
}

// Between two keys both amplitudes go from one to the other, so their sum is never larger than at one of them.
double FishMotion::largest_contraction(int segment, Side side) const {
  double largest = 0.0;
  for (const MotionKey& key : options_.keys)
    largest = std::max(
        largest, (swims(segment) ? key.swim : 0.0) + (turns(segment) ? std::max(handed(side) * key.turn, 0.0) : 0.0));
  return std::min(largest, 1.0);
}

}  // namespace billow::sim
