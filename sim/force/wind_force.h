// The air's push and pull on a body's faces as a law of force.
#pragma once

#include <vector>

#include "sim/force/force_law.h"
#include "sim/force/wind_field.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

struct Wind {
  /// Of the drag. Up to here the force is that of a dissipation function whatever the speed: its C is symmetric and has
  /// no negative eigenvalue.
  static constexpr double most_lift = 0.6;

  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // [m/s] of the mean wind
  std::optional<Gusts> gusts = {};
  double drag = 1.2;           // coefficient of a plate square to the wind
  double lift = 0.72;          // twice the coefficient of a plate at 45 degrees, at most most_lift drag
  double density = 1.2;        // [kg/m^3] of the air
  double quadratic_to = 20.0;  // [m/s] relative speed up to which the force grows with its square
};

/// A flat plate in a flow, quasi-steady, as Dickinson, Lehmann & Sane 1999 measured it and Andersen, Pesavento & Wang
/// 2005 use it: with v the face's velocity (the mean of its corners') less the air's, A its area, n its normal and t
/// the angle between the two, it feels
///
///     drag  1/2 rho A |v|^2 (drag - 3/2 lift sin^2 t)  against v,
///     lift  1/2 rho A |v|^2 lift sin t cos t           across v in the plane of v and n, away from the side it meets.
///
/// n and -n are the same, the force and its slope are continuous, also through a wind along the face, and both are the
/// one vector
///
///     F = -1/2 rho A |v| ((drag - 3/2 lift + 1/2 lift (n.v)^2 / |v|^2) v + lift (n.v) n),
///
/// minus the gradient by v of the dissipation function 1/6 rho A |v|^3 (drag - 3/2 lift sin^2 t): this ties the drag of
/// a plate along the wind to the lift, and in turn C = -dF/dv is symmetric. Quads count as one face with their area
/// vector; a face that has grown beyond `largest_growth` times its area at rest counts with that.
///
/// A square of the speed has no bound. From the relative speed `quadratic_to` = V on, |v|^3 in the dissipation function
/// goes on as the parabola 3 V |v|^2 - 3 V^2 |v| + V^3 that touches it to second order, so that a plate square to the
/// wind feels 2 V |v| - V^2 in place of |v|^2: C is at most 2.005 times 1/2 rho A drag V, whatever the motion.
class WindForce : public ForceLaw {
 public:
  static constexpr double largest_growth = 1.6;  // of a face's area

  /// `faces` are of the body that starts at `first_particle`; their areas at rest are those of the structure.
  WindForce(const Structure& structure, const Wind& wind, const std::vector<Face>& faces, int first_particle);
  std::string_view name() const override { return "the wind"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  double energy(const State&) const override { return 0.0; }
  /// The `definite` form has C, and leaves out how the force turns with the face and changes from place to place.
  void add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                         StiffnessMatrix& matrix) const override;
  /// Every face in the steepest flow at once, from whichever side: as large as at rest, or grown by largest_growth.
  bool add_bound(Shapes shapes, Linearisation& bound) const override;
  /// Where nothing moves relative to the air, nothing is damped.
  void add_least_damping(StiffnessMatrix&) const override {}
  /// In still air.
  bool passive() const override { return field_.mean().isZero(0.0); }
  /// What the wind carries in: its push times its own velocity, halfway between the two states.
  double work(const State& before, const State& after) const override;
  bool join(FusedSweep&) const override { return false; }

 private:
  struct Panel {
    Face corner;       // particles of the whole structure
    double rest_area;  // [m^2]
  };
  struct Flow;
  Flow flow_at(const State& state, const Panel& panel) const;
  /// [N]
  Eigen::Vector3d push(const Flow& flow) const;
  /// of(flow) of every face, `none` where a face has no area.
  template <class Value, class Of>
  std::vector<Value> of_panels(const State& state, const Value& none, const Of& of) const;

  const Structure& structure_;
  Wind wind_;
  WindField field_;
  std::vector<Panel> panel_;
};

}  // namespace billow::sim
