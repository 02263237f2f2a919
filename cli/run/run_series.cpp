// Groups that keep their extremes.
#include "cli/run/run_series.h"

#include <algorithm>

#include "cli/run/film.h"

namespace billow::cli {

namespace {

// In the order of Quantity: what is measured, and the energies' sum.
std::array<double, 12> quantities_of(const FrameRecord& record) {
  const auto measures = measures_of(record);
  std::array<double, 12> quantities{};
  std::copy(measures.begin(), measures.end(), quantities.begin());
  quantities.back() = record.kinetic + record.potential;
  return quantities;
}

}  // namespace

void RunSeries::add(const FrameRecord& record) {
  groups_.reserve(max_points / 2);  // at once: memory that grows piece by piece leaves holes
  if (first_frame_ == 0) first_frame_ = record.frame;
  last_frame_ = record.frame;
  if (groups_.empty() || last_size_ == group_size_) {
    if (groups_.size() == max_points / 2) merge_pairs();
    groups_.emplace_back();
    last_size_ = 0;
  }
  const std::array<double, quantities> values = quantities_of(record);
  Group& group = groups_.back();
  for (int q = 0; q < quantities; ++q) {
    const PlotPoint point{record.time, values[q]};
    if (last_size_ == 0 || point.value < group.low[q].value) group.low[q] = point;
    if (last_size_ == 0 || point.value > group.high[q].value) group.high[q] = point;
  }
  ++last_size_;
}

// Called when every group is full and their number even.
void RunSeries::merge_pairs() {
  for (std::size_t g = 0; g < groups_.size() / 2; ++g) {
    const Group &first = groups_[2 * g], &second = groups_[2 * g + 1];
    Group merged = first;
    for (int q = 0; q < quantities; ++q) {
      if (second.low[q].value < merged.low[q].value) merged.low[q] = second.low[q];
      if (second.high[q].value > merged.high[q].value) merged.high[q] = second.high[q];
    }
    groups_[g] = merged;
  }
  groups_.resize(groups_.size() / 2);
  group_size_ *= 2;
}

std::vector<PlotPoint> RunSeries::points(Quantity quantity) const {
  std::vector<PlotPoint> points;
  for (const Group& group : groups_) {
    const PlotPoint low = group.low[static_cast<int>(quantity)], high = group.high[static_cast<int>(quantity)];
    points.push_back(low.time <= high.time ? low : high);
    if (low.time != high.time) points.push_back(low.time <= high.time ? high : low);
  }
  return points;
}

}  // namespace billow::cli
