// Records as plain numbers, one after another.
#include "cli/run/frame_log.h"

#include <algorithm>
#include <array>

namespace billow::cli {

namespace {

using Row = std::array<double, 13>;  // whole numbers of frames are exact in a double up to 2^53

Eigen::Vector3d vector_at(const Row& row, std::size_t first) { return {row[first], row[first + 1], row[first + 2]}; }

}  // namespace

std::array<double, 11> measures_of(const FrameRecord& record) {
  const Eigen::Vector3d &p = record.linear_momentum, &l = record.angular_momentum;
  return {record.kinetic,
          record.potential,
          p.x(),
          p.y(),
          p.z(),
          l.x(),
          l.y(),
          l.z(),
          record.stretch.largest,
          record.stretch.mean,
          static_cast<double>(record.touching)};
}

void FrameLog::add(const FrameRecord& record) {
  Row row{static_cast<double>(record.frame), record.time};
  const auto measures = measures_of(record);
  std::copy(measures.begin(), measures.end(), row.begin() + 2);
  spool_.append(row.data(), sizeof row);
  ++size_;
}

FrameRecord FrameLog::at(long index) const {
  Row row;
  spool_.read(row.data(), sizeof row, static_cast<std::size_t>(index) * sizeof row);
  return {static_cast<long>(row[0]), row[1], row[2], row[3], vector_at(row, 4), vector_at(row, 7), {row[10], row[11]},
          static_cast<long>(row[12])};
}

}  // namespace billow::cli
