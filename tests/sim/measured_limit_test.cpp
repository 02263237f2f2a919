// The certificate against real runs: a filtered sheet that falls keeps its energy just below the certified limit, and
// loses hold of it just above the measured one.
#include "sim/measured_limit.h"

#include <gtest/gtest.h>

#include "sim/certificate.h"
#include "sim/filter.h"
#include "sim/forces.h"
#include "sim/power_method.h"
#include "sim/stiffness_scale.h"
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
    return certified_step(structure_, linearise_at_rest(structure_), structure_.rest_position, Method::fb_euler, {},
                          &filter)
        .step;
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

}  // namespace
}  // namespace billow::sim
