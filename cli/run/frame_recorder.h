// The frames of a run, on their way from the simulation to the stage that draws them.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "cli/run/channel.h"
#include "cli/run/recorder.h"
#include "cli/run/schedule.h"

namespace billow::cli {

/// Where the drawn bodies are in one frame.
struct Snapshot {
  long frame = 0;
  double time = 0.0;
  std::vector<sim::SurfaceState> bodies;
  Eigen::Vector3d camera_velocity = Eigen::Vector3d::Zero();  // [m/s]
};

/// Records what is to be drawn and hands it over.
class FrameRecorder : public Recorder {
 public:
  FrameRecorder(const RecorderSetting& setting, const FrameRange& range, Channel<Snapshot>& drawing)
      : drawn_(setting.run.drawn),
        range_(range),
        frames_(frame_schedule(setting.run.scene, range.last)),
        drawing_(drawing) {
    frames_.pass_to(range.first);
  }
  double wants() const override { return frames_.next(); }
  void add(double time, const sim::State& state) override {
    if (frames_.take(time) && range_.contains(frames_.taken()))
      next_ = {frames_.taken(), time, drawn_.surfaces(state), drawn_.camera_velocity(state)};
  }
  void finish() override { drawing_.close(); }

  /// Waits for room in the queue. False when nobody draws any more.
  bool hand_over() {
    if (!next_) return true;
    Snapshot snapshot = std::move(*next_);
    next_.reset();
    return drawing_.push(std::move(snapshot));
  }

 private:
  const DrawnScene& drawn_;
  FrameRange range_;
  Schedule frames_;
  Channel<Snapshot>& drawing_;
  std::optional<Snapshot> next_;
};

}  // namespace billow::cli
