// Times, one after another.
#include "cli/run/schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace billow::cli {

namespace {

constexpr long many = std::numeric_limits<long>::max();

// Shares of the end by which rounding may miss it.
constexpr double rounding = 1e-12;

}  // namespace

Schedule Schedule::every(double step, double end) { return {Rule::every, step, end, many}; }

Schedule Schedule::frames(double fps, long last) { return {Rule::frames, fps, INFINITY, last}; }

Schedule Schedule::once(double time, double end) { return {Rule::once, time, end, 1}; }

// Nothing is sampled every infinite time, not even at 0.
double Schedule::next() const {
  if (taken_ >= last_) return INFINITY;
  if (rule_ == Rule::frames) return static_cast<double>(taken_) / number_;
  if (rule_ == Rule::once) return number_ <= end_ * (1.0 + rounding) ? number_ : INFINITY;
  const double time = std::isfinite(number_) ? static_cast<double>(taken_) * number_ : INFINITY;
  return time < end_ * (1.0 - rounding) ? time : INFINITY;
}

bool Schedule::take(double time) {
  if (!(next() <= time + together)) return false;
  ++taken_;
  return true;
}

double Moments::next() const {
  double next = INFINITY;
  for (const Schedule& schedule : schedules_) next = std::min(next, schedule.next());
  return next;
}

double Moments::take() {
  const double time = next();
  for (Schedule& schedule : schedules_) schedule.take(time);
  return time;
}

double end_of_run(const Scene& scene, long last_frame) {
  return std::min(scene.duration, static_cast<double>(last_frame) / scene.render.fps);
}

Schedule frame_schedule(const Scene& scene, long last_frame) { return Schedule::frames(scene.render.fps, last_frame); }

Schedule strip_schedule(const Scene& scene, long last_frame) {
  return Schedule::every(scene.strip ? scene.strip->step : INFINITY, end_of_run(scene, last_frame));
}

Schedule spectrum_schedule(const Scene& scene, long last_frame) {
  return Schedule::every(scene.spectrum ? scene.spectrum->step : INFINITY, end_of_run(scene, last_frame));
}

Schedule velocity_image_schedule(const Scene& scene, long last_frame) {
  return Schedule::once(scene.spectrum ? scene.spectrum->at : INFINITY, end_of_run(scene, last_frame));
}

std::vector<Schedule> all_schedules(const Scene& scene, long last_frame) {
  return {frame_schedule(scene, last_frame), strip_schedule(scene, last_frame), spectrum_schedule(scene, last_frame),
          velocity_image_schedule(scene, last_frame)};
}

}  // namespace billow::cli
