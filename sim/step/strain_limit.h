// Cloth that does not stretch like rubber: springs are kept from growing beyond a share of their length.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/body/structure.h"
#include "sim/step/pulls.h"
#include "sim/step/step.h"

namespace billow::sim {

/// After Provot 1995, as impulses (Bridson, Fedkiw & Anderson 2002): where a step would leave a structural or shear
/// spring longer than (1 + limit) rest lengths, its two ends pull each other along it so that it is not. Momenta are
/// kept to rounding, pinned particles keep their velocities, and what lengthens beyond the limit stops doing so as in
/// an inelastic impact: energy is lost. A spring that is already beyond is brought back slowly, a share of the way a
/// step; what that puts in is work(). Bend springs are left alone: two limited ones run along each.
///
/// How long a spring gets is judged over the whole time h for which velocities are kept, from the positions that they
/// go on from. RK4 and forward Euler have moved by older velocities already, so that theirs are limited a step late.
///
/// Where no spring is too long, nothing is changed, and one pass over them is all that it costs. Where some are, they
/// and those beside them that would be are solved for together (sim/step/pulls.h), beginning with the forces of the
/// last step, until none is wrong by more than a two thousandth of its length or iterations run out.
class StrainLimit : public StepHook {
 public:
  static constexpr int most_iterations = 30;

  /// limit [rest lengths]: one for each of the structure's bodies, above 0, infinite for none. The structure must
  /// outlive this.
  StrainLimit(const Structure& structure, const std::vector<double>& limit);

  void begin(State& state, double h) override;
  void apply(const State& state, const Move& move, Eigen::MatrixX3d& velocity) override;
  void forget() override;
  /// Of moving pins, through the springs that are held; and of bringing springs back.
  double work() const override { return work_; }

  /// Of the last step; 0 where no spring was too long.
  int iterations() const { return iterations_; }

 private:
  /// One that is limited.
  struct Spring {
    int first, second;
    double longest;  // [m] that it may be
  };
  /// Springs [begin, end) that join particles i, i + 1, ... with those a stride farther, i being the first's first; a
  /// stride of 0 for springs without such an order.
  struct Row {
    int begin, end, stride;
  };
  /// What a step goes on from: (n x 3) [m] and [m/s], both as they are before anything is pulled.
  struct Motion {
    const Eigen::MatrixX3d& position;
    const Eigen::MatrixX3d& velocity;
  };

  void list_springs(const std::vector<double>& limit);
  void list_rows();
  void list_beside();
  bool find_near(const Motion& motion);
  bool find_near(int begin, int end, std::vector<int>& near) const;
  bool find_in_row(int stride, int begin, int end, std::vector<int>& near) const;
  bool find_scattered(int begin, int end, std::vector<int>& near) const;
  bool note_if_near(int spring, std::vector<int>& near) const;
  void add(int spring, const Motion& motion);
  int mover_of(int particle, const Motion& motion);
  double allowed(const Spring& spring, const Motion& motion, const Eigen::Vector3d& direction, double length);
  void solve(const Motion& motion);
  double work_of_shortening(const Motion& motion) const;
  bool grow(const Motion& motion);
  bool is_pushed(int spring, int particle, const Motion& motion) const;
  Eigen::Vector3d velocity_of(int particle, const Motion& motion) const;
  void take_over(Eigen::MatrixX3d& velocity);

  const Structure& structure_;
  std::vector<Spring> spring_;          //       by body, stride and first particle
  std::vector<Row> row_;                //       all of them
  std::vector<int> first_beside_;       // (n+1) where in beside_ each particle's springs begin
  std::vector<int> beside_;             //       springs, by particle
  Eigen::ArrayXd near_square_;          // [m^2] of the length from which each takes part
  std::vector<double> force_;           // [N]   of each in the last step
  std::vector<int> remembered_;         //       those whose force is not 0
  Eigen::MatrixX3d moved_, predicted_;  // [m]   (n x 3)
  std::vector<std::vector<int>> near_;  //       those that take part, by the part of the pass that found them
  Pulls pulls_;
  std::vector<int> pulled_;           //       the spring of each pull
  std::vector<int> pulled_particle_;  //       the particle of each mover
  std::vector<int> mover_;            // (n)   of each particle, or -1
  std::vector<char> takes_part_;      //       whether each spring does
  double h_ = 0.0, work_ = 0.0;       // [s], [J] of the last step
  int iterations_ = 0;
  bool beyond_ = false;  //       some spring was too long before the step
};

}  // namespace billow::sim
