// The water's resistance to a body's skin as a law of force.
#pragma once

#include <vector>

#include "sim/force/force_law.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

struct Water {
  double resistance = 1000.0;  // [kg/(m^2 s)] pressure per speed of a face that moves against it
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // [m/s] its current, the same everywhere
};

/// Tu & Terzopoulos 1994, equation 2: a face of area A and outward normal n that moves with v relative to the water is
/// pushed by F = min(0, -c A (n . v)) n, in equal shares to its corners; v is the mean of theirs. Water only ever
/// pushes on what moves into it, so its power on a body in still water is never positive.
class WaterForce : public ForceLaw {
 public:
  /// The bound counts with faces up to this many times as large as at rest (1.47 in scenes/fish.yaml, 1.26 in a fish of
  /// all defaults, over 10 s).
  static constexpr double largest_growth = 1.6;

  /// `faces` are of the body that starts at `first_particle`, closed, counter-clockwise seen from outside; the bound
  /// takes their sizes from the structure's rest shape.
  WaterForce(const Structure& structure, const Water& water, const std::vector<Face>& faces, int first_particle);
  std::string_view name() const override { return "the water's resistance"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  double energy(const State&) const override { return 0.0; }
  /// The `definite` form has the pressure's dependence on the velocity, C = c A / m^2 n n^T between any two of a face's
  /// m corners where it is pushed, and leaves out how it turns with the face, which is not symmetric.
  void add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                         StiffnessMatrix& matrix) const override;
  /// Every face pushed at once: as it is at rest, or turned any way and grown by largest_growth.
  bool add_bound(Shapes shapes, Linearisation& bound) const override;
  void add_least_damping(StiffnessMatrix&) const override {}
  /// In still water.
  bool passive() const override { return water_.velocity.isZero(0.0); }
  /// What the current carries in: its push times its own velocity.
  double work(const State& before, const State& after) const override;
  bool join(FusedSweep&) const override { return false; }

 private:
  struct Flow;
  Flow flow_at(const State& state, const Face& face) const;

  const Structure& structure_;
  Water water_;
  std::vector<Face> face_;  // particles of the whole structure
};

}  // namespace billow::sim
