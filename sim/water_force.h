// Water as laws of force: its resistance to a body's skin, and what it carries of a body's weight.
#pragma once

#include <vector>

#include "sim/forces.h"
#include "sim/mesh.h"

namespace billow::sim {

struct Water {
  double resistance = 1000.0;  // [kg/(m^2 s)] pressure per speed of a face that moves against it
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // [m/s] its current, the same everywhere
};

/// Tu & Terzopoulos 1994, equation 2: a face of area A and outward normal n that moves with v relative to the water is
/// pushed by F = min(0, -c A (n . v)) n, in equal shares to its corners; v is the mean of theirs. Water only ever
/// pushes on what moves into it, so its power on a body in still water is never positive.
class WaterForce : public ForceTerm {
 public:
  /// `faces` are of the body that starts at `first_particle`, closed, counter-clockwise seen from outside.
  WaterForce(const Water& water, const std::vector<Face>& faces, int first_particle);
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;

 private:
  Water water_;
  std::vector<Face> face_;  // particles of the whole structure
};

/// f = -share m gravity on every particle of a body: 1 makes it float where it is.
class Buoyancy : public ForceTerm {
 public:
  Buoyancy(const Structure& structure, int body, const Eigen::Vector3d& gravity, double share)
      : structure_(structure), body_(structure.body[static_cast<std::size_t>(body)]), lift_(-share * gravity) {}
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  double energy(const State& state) const override;

 private:
  const Structure& structure_;
  const Body& body_;
  Eigen::Vector3d lift_;  // [m/s^2]
};

}  // namespace billow::sim
