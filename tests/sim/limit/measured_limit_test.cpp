// The certificate against real runs: a filtered sheet that falls keeps its energy just below the certified limit, and
// loses hold of it just above the measured one.
#include "sim/limit/measured_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "sim/filter/filter.h"
#include "sim/force/forces.h"
#include "sim/force/spring_force.h"
#include "sim/limit/certificate.h"
#include "sim/limit/filtered_eigenvalue.h"
#include "sim/limit/paper_step.h"
#include "sim/limit/stiffness_scale.h"
#include "sim/linear/max_eigenvalue.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

// The reference sheet of docs/method.md, held at two corners, falling under gravity.
class FallingSheet : public testing::Test {
 protected:
  static Structure sheet() {
    Structure grid = test::grid({.spacing = 1.0 / 9.0, .pinned = {0, 9}});
    scale_stiffness(grid, 1e6);
    return grid;
  }
  SolverOptions with(const FilterOptions& filter, double step) const {
    SolverOptions options;
    options.filter = filter;
    options.step = step;
    return options;
  }
  bool keeps_its_energy(const FilterOptions& filter, double step) const {
    return runs_stably(structure_, forces_, with(filter, step), start_, scale_, measurement_);
  }
  double certified(const FilterOptions& options) const {
    const Filter filter(structure_, options);
    const Linearisation linearisation = linearise_at_rest(structure_);
    return certified_step({structure_, linearisation, structure_.rest_position, Method::fb_euler, {}, &filter}).step;
  }
  double measured(const FilterOptions& filter) const {
    return measured_step(structure_, forces_, with(filter, 0.0), start_, scale_, certified(filter), 0.02, measurement_)
        .step;
  }
  double paper(const FilterOptions& options) const {
    const StiffnessMatrix stiffness = linearise_at_rest(structure_).stiffness;
    return *paper_step(Method::fb_euler, filtered_eigenvalue(structure_, stiffness, Filter(structure_, options)).value);
  }

  const Structure structure_ = sheet();
  const Eigen::Vector3d gravity_{0.0, -9.81, 0.0};
  const Forces forces_{structure_, gravity_};
  const State start_ = rest_state(structure_);
  const double scale_ = energy_scale(structure_, forces_, gravity_, start_);
  const MeasurementOptions measurement_{.duration = 3.0};
};

TEST_F(FallingSheet, RunsToTheCertifiedLimitOfAVelocityFilterAndNotToThePapers) {
  for (const FilterForm form : {FilterForm::plain, FilterForm::symmetric, FilterForm::conserving}) {
    SCOPED_TRACE(static_cast<int>(form));
    const FilterOptions filter{.form = form, .target = FilterTarget::velocity};
    EXPECT_TRUE(keeps_its_energy(filter, 0.98 * certified(filter)));
    EXPECT_FALSE(keeps_its_energy(filter, 1.05 * measured(filter)));
    EXPECT_FALSE(keeps_its_energy(filter, paper(filter)));
  }
}

// The paper's criterion and the certificate are one for a force filter.
TEST_F(FallingSheet, HasOneLimitForAForceFilter) {
  const FilterOptions filter{.form = FilterForm::conserving, .target = FilterTarget::force};
  EXPECT_NEAR(certified(filter), paper(filter), 0.01 * paper(filter));
}

/// A run of oscillators along x, each drawn out by its own length [m].
struct Oscillators {
  Oscillators(const std::vector<double>& friction, const std::vector<double>& drawn_out) {
    for (const double c : friction) {
      parts.push_back(test::oscillator(mass, stiffness));
      parts.back().body[0].friction = c;
    }
    structure = merge(parts);
    start = rest_state(structure);
    for (std::size_t k = 0; k < drawn_out.size(); ++k) start.position(2 * static_cast<int>(k) + 1, 0) += drawn_out[k];
    forces = std::make_unique<Forces>(structure, Eigen::Vector3d::Zero());
  }
  double scale() const { return energy_scale(structure, *forces, Eigen::Vector3d::Zero(), start); }
  MeasuredStep measured(Method method, double guess, double tolerance) const {
    return measured_step(structure, *forces, {.method = method}, start, scale(), guess, 0.1,
                         {.duration = duration, .energy_tolerance = tolerance});
  }
  bool stable(Method method, double h, double tolerance) const {
    return runs_stably(structure, *forces, {.method = method, .step = h}, start, scale(),
                       {.duration = duration, .energy_tolerance = tolerance});
  }

  static constexpr double mass = 0.5, stiffness = 80.0, omega_square = stiffness / mass, duration = 1.0;
  std::vector<Structure> parts;
  Structure structure;
  State start;
  std::unique_ptr<Forces> forces;
};

// Energy grows by 1 + (omega h)^2 a step, so over a time T by e^(omega^2 h T): nothing explodes, and yet there is a
// step beyond which the gain exceeds the tolerance.
TEST(MeasuredStep, OfForwardEulerIsWhereItGainsTheToleranceOfEnergy) {
  const Oscillators one({0.0}, {0.01});
  for (const double tolerance : {0.2, 0.5}) {
    const double expected = std::log1p(tolerance) / (Oscillators::omega_square * Oscillators::duration);
    for (const double guess : {0.3 * expected, 3.0 * expected}) {
      const MeasuredStep measured = one.measured(Method::forward_euler, guess, tolerance);
      EXPECT_NEAR(measured.step, expected, 0.02 * expected);
      EXPECT_FALSE(measured.unlimited);
    }
  }
}

TEST(MeasuredStep, IsUnlimitedWhereEnergyIsOnlyLost) {
  const MeasuredStep measured = Oscillators({0.0}, {0.01}).measured(Method::backward_euler, 0.01, 0.05);
  EXPECT_TRUE(measured.unlimited);
  EXPECT_EQ(measured.step, 0.1);
}

// Most of the energy is lost at once to friction; what is left of it gains a tenth of it all, and never comes near what
// there was.
TEST(RunsStably, LooksAtTheClimbFromTheLowestEnergySoFar) {
  const double c = 20.0 * Oscillators::mass, h = 0.0025;
  const Oscillators both({c, 0.0}, {0.01, 0.01 * std::sqrt(0.25)}), rubbed({c}, {0.01});
  const double gain = 0.2 * std::expm1(Oscillators::omega_square * h * Oscillators::duration);
  EXPECT_FALSE(both.stable(Method::forward_euler, h, 0.6 * gain)) << "it is lowest after a while";
  EXPECT_TRUE(both.stable(Method::forward_euler, h, 1.1 * gain));
  EXPECT_TRUE(rubbed.stable(Method::forward_euler, h, 0.6 * gain));
}

TEST(RunsStably, CountsARunThatIsTornApartAsUnstable) {
  const Oscillators one({0.0}, {0.01});
  const double unit = 2.0 / std::sqrt(Oscillators::omega_square);
  EXPECT_FALSE(one.stable(Method::fb_euler, 2.0 * unit, HUGE_VAL));
  EXPECT_TRUE(one.stable(Method::fb_euler, 0.9 * unit, HUGE_VAL));
}

}  // namespace
}  // namespace billow::sim
