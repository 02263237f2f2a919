// Energy, momentum and stretch over a run of any length, kept small enough to plot.
#pragma once

#include <array>
#include <vector>

#include "cli/page/line_plot.h"

namespace billow::cli {

struct FrameRecord;

/// What a run's page plots.
enum class Quantity {
  kinetic,
  potential,
  linear_x,
  linear_y,
  linear_z,
  angular_x,
  angular_y,
  angular_z,
  largest_stretch,
  mean_stretch,
  touching,
  total,
};

/// Takes frame after frame in bounded memory. Up to 1,000 frames are kept as they are; of more, neighbours are merged
/// and each group keeps every quantity's smallest and largest value, so that no peak is lost.
class RunSeries {
 public:
  static constexpr int max_points = 2000;  // of each quantity

  /// Frames must come in the order of their times.
  void add(const FrameRecord& record);

  /// The curve of one quantity, in the order of time: at most max_points.
  std::vector<PlotPoint> points(Quantity quantity) const;

  /// False once frames were merged: the curves then show extremes, and between these no more than that.
  bool exact() const { return group_size_ == 1; }

  /// Numbers of the first and last frame; 0 when there is none.
  long first_frame() const { return first_frame_; }
  long last_frame() const { return last_frame_; }

 private:
  static constexpr int quantities = 12;
  struct Group {
    std::array<PlotPoint, quantities> low, high;
  };

  void merge_pairs();

  std::vector<Group> groups_;  // each of group_size_ frames, the last of last_size_
  long group_size_ = 1, last_size_ = 0;
  long first_frame_ = 0, last_frame_ = 0;
};

}  // namespace billow::cli
