// Where something rigid is at a time, by keys: colliders and pins that a scene moves.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace billow::sim {

/// Where something rigid is put at one time, from where its mesh has it.
struct PlaceKey {
  double time = 0.0;                                      // [s]
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     // [rad] about the fixed x axis, then y, then z; may exceed
                                                          // a whole turn
};

/// A rigid motion through keys: every component by the monotone cubic of Fritsch & Carlson 1980, so that nothing
/// overshoots, at rest at the first and the last key and outside them. Position and velocity are continuous.
class KeyedMotion {
 public:
  /// Rests where it is.
  KeyedMotion() = default;
  /// Keys ascend strictly in time; none: rests where it is. Rotations turn about `pivot` [m]. Throws InputError.
  KeyedMotion(std::vector<PlaceKey> keys, const Eigen::Vector3d& pivot);

  /// Maps a point of the mesh to where it is at `time` [s].
  Eigen::Isometry3d at(double time) const;
  /// Maps a point of the mesh to the velocity [m/s] that it has at `time` [s].
  Eigen::Affine3d velocity_at(double time) const;
  /// Whether anything is ever elsewhere than its mesh has it.
  bool moves() const;

 private:
  using Components = Eigen::Matrix<double, 6, 1>;  // [m] of the translation, then [rad] of the rotation

  /// Values and rates of all components at `time`.
  struct Place {
    Components value = Components::Zero(), rate = Components::Zero();
  };
  Place place(double time) const;

  std::vector<double> time_;               // [s] of each key
  std::vector<Components> value_, slope_;  // at each key
  Eigen::Vector3d pivot_ = Eigen::Vector3d::Zero();
};

}  // namespace billow::sim
