// Pins that move by keys and carry pinned particles along.
#pragma once

#include <vector>

#include "sim/body/keyed_motion.h"
#include "sim/step/step.h"

namespace billow::sim {

/// Pinned particles that one motion carries along, from where the structure has them at rest.
struct MovingPin {
  std::vector<int> particle;
  KeyedMotion motion;
};

/// Moves `pins`, whose particles `structure` pins, each in one pin alone. Every step ends with them where the motion
/// has them then, at the velocity that it has then; during the step they go there evenly.
/// Structure and forces must outlive the hook.
class MovingPins : public StepHook {
 public:
  MovingPins(const Structure& structure, const Forces& forces, const std::vector<MovingPin>& pins);

  void begin(State& state, double h) override;
  void end(State& state) override;
  void forget() override { force_known_ = false; }
  double work() const override { return work_; }

 private:
  struct Carried {
    int particle;
    std::size_t pin;
  };

  void find_force(const State& state, Eigen::MatrixX3d& force);
  double kinetic_energy(const State& state) const;

  const Structure& structure_;
  const Forces& forces_;
  std::vector<MovingPin> pins_;
  std::vector<Carried> carried_;  // (c) all particles of all pins

  Eigen::MatrixX3d start_, target_;  // (c x 3) [m] before and after the step under way
  double before_ = 0.0;              // [J] kinetic energy of the pins before it
  Eigen::MatrixX3d force_;           // (c x 3) [N] on the particles at the state that the last step ended at,
  bool force_known_ = false;         //         where the pins moved in it
  double work_ = 0.0;                // [J] of the last step
  Eigen::MatrixX3d end_force_, all_forces_;
  ForceScratch scratch_;
};

}  // namespace billow::sim
