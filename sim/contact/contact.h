// Contact as a part of every step: nothing passes through anything.
#pragma once

#include <string>
#include <vector>

#include "sim/contact/contact_options.h"
#include "sim/contact/contact_surface.h"
#include "sim/contact/detection.h"
#include "sim/contact/impulses.h"
#include "sim/step/step.h"

namespace billow::sim {

/// What touches what, for any number of runs. Structure and options must outlive it.
class ContactModel {
 public:
  ContactModel(const Structure& structure, const ContactOptions& options);

  const ContactSurface& surface() const { return surface_; }
  const ContactOptions& options() const { return options_; }
  /// The colliders' vertices where they are at `time` [s], into x (N).
  void place_colliders(double time, Points& x) const;

 private:
  const ContactOptions& options_;
  ContactSurface surface_;
};

/// Between filter and move: velocities by impulses. After it: whoever would leave its cell stops at its border, and
/// where that would keep colliders back, the step's way is gone in shares.
class Contact : public StepHook {
 public:
  /// `model` must outlive this.
  explicit Contact(const ContactModel& model);

  void begin(State& state, double h) override;
  void apply(const State& state, const Move& move, Eigen::MatrixX3d& velocity) override;
  /// Throws BlockedError where a collider presses a body that has nowhere to go.
  void end(State& state) override;
  void forget() override { detection_.forget(), impulses_.forget(); }
  double work() const override { return work_; }
  bool straight() const override { return straight_; }

  const Detection& detection() const { return detection_; }
  /// So far: looks at the surface, and steps that went in shares.
  long detections() const { return detection_.number(); }
  long shared_steps() const { return shared_steps_; }

 private:
  /// A half-space for one step.
  struct Plane {
    std::string name;
    Eigen::Vector3d point, normal;            // [m] as it begins
    Eigen::Vector3d next_point, next_normal;  // as it ends
    Eigen::Isometry3d turn;                   // from the one to the other
    double thickness, friction;
    bool moves;
  };
  void place_planes();
  void find_spins();
  void detect();
  void find_plane_contacts(const Points& x);
  double height_over(const Plane& plane, const Eigen::Vector3d& x, double share) const;
  void arrive(const State& state, const Move& move);
  bool holds();
  void go_in_shares(State& state);
  void keep_above_planes(const Points& x, double from, Points& way) const;
  bool is_above_planes(int v, const Eigen::Vector3d& x, double share) const;
  [[noreturn]] void crushed() const;
  [[noreturn]] void blocked(const std::string& one, const std::string& other) const;

  const ContactModel& model_;
  const ContactSurface& surface_;
  Detection detection_;
  Impulses impulses_;
  Impulses share_impulses_;  // of ways in place of velocities
  std::vector<Plane> plane_;
  std::vector<PlaneContact> plane_contact_;
  double time_ = 0.0, h_ = 0.0, work_ = 0.0;
  double ahead_ = 0.0;     // [steps] of the last look
  Points from_, to_;       // (N) [m] where the step begins and ends
  Points start_;           // (N) [m] from where the new velocities lead there
  bool held_ = true;       // whether all of that is within the cells
  Points velocity_, way_;  // (N) [m/s], [m]
  Points spin_;            // [rad/s] of each part
  std::vector<double> share_;
  std::vector<bool> stopped_;  // (N) somewhere in this step
  bool straight_ = true;
  long shared_steps_ = 0;
};

/// Throws StartError where surfaces cross before the first step at `start`, or a body reaches into a collider, naming
/// both and the faces.
void check_start(const ContactModel& model, const State& start);

}  // namespace billow::sim
