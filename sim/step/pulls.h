// Impulses that pull particles towards one another, as large as they must be and no larger.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace billow::sim {

/// A particle that may be pulled.
struct Mover {
  Eigen::Vector3d velocity;   // [m/s]
  double inverse_mass = 0.0;  // [1/kg] 0: it keeps its velocity
};

/// Two movers that may not go apart faster than is allowed, and the impulse by which they pull one another.
struct Pull {
  int first = 0, second = 0;
  Eigen::Vector3d direction;  //       unit, from the first to the second
  double before = 0.0;        // [m/s] at which they go apart, unpulled
  double allowed = 0.0;       // [m/s] at which they may; negative where they must approach
  double impulse = 0.0;       // [N s] >= 0
  double reduced_mass = 0.0;  // [kg]
  double of_pins = 0.0;       // [m/s] the part of their going apart that movers without inverse mass make
  double step = 0.0;          // [N s] by which the last iteration changed the impulse
};

/// Finds impulses lambda >= 0 by which nothing goes apart faster than is allowed, and none where it is slower.
///
/// With v_n the velocities of going apart, unpulled, c those allowed, and A = J M^-1 J^T, v_n' = v_n - A lambda; lambda
/// makes phi = lambda^T A lambda / 2 - lambda^T (v_n - c) least among lambda >= 0. Each iteration lowers phi, and
/// kinetic energy, less the work of movers that keep their velocity, changes by phi - lambda^T c: whenever one stops,
/// no energy has been put in where c >= 0, and at most -lambda^T c elsewhere. Momenta are kept to rounding.
class Pulls {
 public:
  void clear();
  /// The number of a new mover.
  int add_mover(const Eigen::Vector3d& velocity, double inverse_mass);
  /// Of existing movers, one of which has a mass; `before`, `of_pins` and `reduced_mass` are filled in.
  void add(Pull pull);

  int movers() const { return static_cast<int>(mover_.size()); }
  int count() const { return static_cast<int>(pull_.size()); }
  const Eigen::Vector3d& velocity(int mover) const { return mover_[static_cast<std::size_t>(mover)].velocity; }
  bool is_pulled(int mover) const { return velocity(mover) != unpulled_[static_cast<std::size_t>(mover)]; }
  const Pull& pull(int number) const { return pull_[static_cast<std::size_t>(number)]; }

  /// Begins with the impulses that were added, all multiplied by what makes phi least.
  void start();
  /// Twice through all pulls, there and back, each made exactly as large as it must be while the others stay (projected
  /// Gauss-Seidel), then on to where phi is least in the plane of this step and the last one (as the conjugate gradient
  /// does, with Gauss-Seidel for preconditioner). Goes no further, and returns true, when no visit has changed a
  /// velocity of going apart by more than `enough` [m/s].
  bool iterate(double enough);
  /// [J] by which kinetic energy has risen, less the work of movers that keep their velocity.
  double energy_rise() const;
  /// [J] what holds those movers has put in.
  double pin_work() const;
  /// All impulses times so much that energy_rise() is at most 0.
  void take_no_energy();

 private:
  void exert(const Pull& pull, double impulse);
  double visit(Pull& pull);
  void accelerate();
  void go_on(double along_step, double along_last);
  double change_square() const;
  double lost() const;
  void scale(double factor);

  std::vector<Mover> mover_;
  std::vector<Pull> pull_;
  std::vector<Eigen::Vector3d> unpulled_;     // [m/s] velocity that each mover came with,
  std::vector<Eigen::Vector3d> start_;        //       that it had before the iteration under way,
  std::vector<Eigen::Vector3d> last_change_;  //       and by how much the last one changed it
  std::vector<double> start_impulse_;         // [N s] of each pull before the iteration under way
};

}  // namespace billow::sim
