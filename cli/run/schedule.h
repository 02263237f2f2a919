// When a run is looked at.
#pragma once

#include <vector>

#include "cli/scene/scene.h"

namespace billow::cli {

/// Ascending times [s], taken one after another. Times nearer to each other than `together` are the same moment.
class Schedule {
 public:
  static constexpr double together = 1e-9;  // [s]

  /// 0, step, 2 step, ... before `end`.
  static Schedule every(double step, double end);
  /// Frames 1 to `last`, frame f at (f - 1) / fps.
  static Schedule frames(double fps, long last);
  /// `time`, unless the run ends before.
  static Schedule once(double time, double end);

  /// Infinite when there are no more.
  double next() const;
  /// How many have been taken.
  long taken() const { return taken_; }
  /// Takes as many as there are before the one of this number, from 1.
  void pass_to(long number) { taken_ = number - 1; }
  /// Takes the next one if it is due at `time`; says whether it was.
  bool take(double time);

 private:
  enum class Rule { every, frames, once };
  Schedule(Rule rule, double number, double end, long last) : rule_(rule), number_(number), end_(end), last_(last) {}

  Rule rule_;
  double number_;  // step, fps or time
  double end_;
  long last_;  // how many there are at most
  long taken_ = 0;
};

/// Several schedules as one: each moment once, ascending.
class Moments {
 public:
  explicit Moments(std::vector<Schedule> schedules) : schedules_(std::move(schedules)) {}

  /// Infinite when there are no more.
  double next() const;
  /// Takes it from all the schedules that it is in.
  double take();

 private:
  std::vector<Schedule> schedules_;
};

/// [s] where a run that draws frames up to `last_frame` ends: before the samples of the frame after it.
double end_of_run(const Scene& scene, long last_frame);

/// All moments at which such a run is looked at, whatever for.
std::vector<Schedule> all_schedules(const Scene& scene, long last_frame);

// Those of what a scene asks for. Without the spec: none.
Schedule frame_schedule(const Scene& scene, long last_frame);
Schedule strip_schedule(const Scene& scene, long last_frame);
Schedule spectrum_schedule(const Scene& scene, long last_frame);
Schedule velocity_image_schedule(const Scene& scene, long last_frame);

}  // namespace billow::cli
