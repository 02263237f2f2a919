// Wind: a mean velocity and gusts that drift by with it, the same for the same seed everywhere.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

namespace billow::sim {

struct Gusts {
  double strength = 0.2;   // root mean square of their velocity as a share of the mean wind's speed
  double period = 2.0;     // [s] from one gust to the next
  double length = 12.0;    // [m] the same in space
  std::uint64_t seed = 1;  // another one, other gusts
};

/// The velocity of the air at any place and time, after Kraichnan 1970 (Diffusion by a random velocity field): the sum
/// of the mean and a few waves a_j d_j sin(k_j . x - w_j t + p_j). d_j is across k_j, so that the air is not compressed
/// anywhere; the waves travel with the mean wind; from the longest, 1.4 times `period` and `length`, each is shorter
/// than the last by 1/sqrt(2), and weaker by Kolmogorov's spectrum, a_j^2 as w_j^(-2/3).
class WindField {
 public:
  /// `mean` [m/s]. Still air has no gusts.
  WindField(const Eigen::Vector3d& mean, const std::optional<Gusts>& gusts);

  /// [m/s] at `position` [m] and `time` [s].
  Eigen::Vector3d velocity(const Eigen::Vector3d& position, double time) const;
  /// Its derivative by the position [1/s]: entry (i, j) that of component i by coordinate j.
  Eigen::Matrix3d gradient(const Eigen::Vector3d& position, double time) const;
  const Eigen::Vector3d& mean() const { return mean_; }

 private:
  struct Wave {
    Eigen::Vector3d amplitude;  // [m/s] a d
    Eigen::Vector3d number;     // [1/m] k
    double frequency = 0.0;     // [1/s] w
    double phase = 0.0;         // p
  };
  static constexpr int waves = 6;

  Eigen::Vector3d mean_;
  std::optional<std::array<Wave, waves>> wave_;
};

}  // namespace billow::sim
