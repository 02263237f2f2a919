// Energy, momentum and stretch of every frame of a film, kept out of memory so that a film may have any length.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>

#include "base/spool.h"
#include "sim/body/stretch.h"

namespace billow::cli {

/// What is known of the motion at one frame.
struct FrameRecord {
  long frame = 0;
  double time = 0.0;                                  // [s]
  double kinetic = 0.0, potential = 0.0;              // [J]
  Eigen::Vector3d linear_momentum, angular_momentum;  // [kg m/s], [kg m^2/s] about the origin
  sim::Stretch stretch = {};
  long touching = 0;  // particles that touch something (sim/contact/touching.h)
};

/// What of a frame is measured: kinetic and potential energy, the two momenta by axis, largest and mean stretch, and
/// the number of particles that touch.
std::array<double, 11> measures_of(const FrameRecord& record);

/// Records in the order in which they were added; iterate over it as over a vector. Throws OutputError.
class FrameLog {
 public:
  /// Spools to the disk that `purpose` will lie on.
  explicit FrameLog(const std::filesystem::path& purpose) : spool_(purpose) {}

  void add(const FrameRecord& record);
  long size() const { return size_; }
  FrameRecord at(long index) const;

  class Iterator {
   public:
    Iterator(const FrameLog& log, long index) : log_(&log), index_(index) {}
    FrameRecord operator*() const { return log_->at(index_); }
    Iterator& operator++() { return ++index_, *this; }
    bool operator!=(const Iterator& other) const { return index_ != other.index_; }

   private:
    const FrameLog* log_;
    long index_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size_}; }

 private:
  Spool spool_;
  long size_ = 0;
};

}  // namespace billow::cli
