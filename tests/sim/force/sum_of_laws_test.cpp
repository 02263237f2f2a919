// What the laws come to together, summed and swept, linearised and bounded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/body/fish.h"
#include "sim/force/buoyancy.h"
#include "sim/force/fluid_friction.h"
#include "sim/force/forces.h"
#include "sim/force/gravity.h"
#include "sim/force/spring_force.h"
#include "sim/force/water_force.h"
#include "tests/support/evaluations.h"
#include "tests/support/laws.h"

namespace billow::sim {
namespace {

using namespace test::laws;

Eigen::MatrixXd dense(const StiffnessMatrix& matrix) { return Eigen::MatrixXd(matrix.assemble(false)); }

/// Pushes on and on, and has no bound.
class Thrust : public ForceLaw {
 public:
  std::string_view name() const override { return "the thrust"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override { force += state.velocity; }
  double energy(const State&) const override { return 0.0; }
  void add_linearisation(const State&, double, double, JacobianForm, StiffnessMatrix&) const override {}
  bool add_bound(Shapes, Linearisation&) const override { return false; }
  void add_least_damping(StiffnessMatrix&) const override {}
  bool passive() const override { return false; }
  double work(const State&, const State&) const override { return 0.0; }
  bool join(FusedSweep&) const override { return false; }
};

TEST(Forces, NameTheLawsWithoutABoundAndLeaveThemOut) {
  const Structure structure = sheet(SpringModel::linear, DampingModel::projected);
  Forces forces(structure, gravity);
  EXPECT_TRUE(forces.bound(Shapes::any).unbounded.empty());
  forces.add(std::make_unique<Thrust>());
  for (const Shapes shapes : {Shapes::rest, Shapes::any}) {
    const ForceBound bound = forces.bound(shapes);
    EXPECT_THAT(bound.unbounded, testing::ElementsAre("the thrust"));
    const Linearisation expected = test::bound_of(structure, shapes);
    EXPECT_EQ(dense(bound.linearisation.stiffness), dense(expected.stiffness));
    EXPECT_EQ(dense(bound.linearisation.damping), dense(expected.damping));
  }
}

TEST(Forces, AreBoundedAtRestByTheSpringsAndFrictionLinearisedThere) {
  const Structure structure = sheet(SpringModel::choi_ko, DampingModel::projected);
  const Linearisation bound = test::bound_of(structure, Shapes::rest), expected = linearise_at_rest(structure);
  EXPECT_EQ(dense(bound.stiffness), dense(expected.stiffness));
  EXPECT_EQ(dense(bound.damping), dense(expected.damping));
}

TEST(Forces, LineariseIntoAMatrixThatHasBeenUsedAsIntoANewOne) {
  const Structure structure = ring_and_fish();
  Forces forces(structure, gravity);
  forces.add(std::make_unique<WaterForce>(structure, Water{resistance, current}, fish_faces(), first_fish_particle));
  StiffnessMatrix used = forces.linearise(shaken(structure, 1), 1.0, 1.0, JacobianForm::exact);
  const State state = shaken(structure, 2);
  forces.linearise(state, 0.3, 0.2, JacobianForm::exact, used);
  EXPECT_EQ(dense(used), dense(forces.linearise(state, 0.3, 0.2, JacobianForm::exact)));
}

TEST(Forces, ArePassiveOnlyWhereEveryLawIs) {
  const Structure structure = sheet(SpringModel::linear, DampingModel::projected);
  Forces forces(structure, gravity);
  EXPECT_TRUE(forces.passive());
  forces.add(std::make_unique<Thrust>());
  EXPECT_FALSE(forces.passive());
}

// Summed law by law and swept at once, whichever of them joins the sweep.
TEST(Forces, AreTheSumOfTheirLaws) {
  const Structure structure = ring_and_fish();
  Forces forces(structure, gravity);
  forces.add(std::make_unique<FluidFriction>(structure));  // a second one, which the sweep has no place for
  forces.add(std::make_unique<Gravity>(structure, current));
  forces.add(std::make_unique<Buoyancy>(structure, fish_body, gravity, 0.8));
  forces.add(std::make_unique<WaterForce>(structure, Water{resistance, current}, fish_faces(), first_fish_particle));
  const State state = shaken(structure, 2);
  Eigen::MatrixX3d expected = Eigen::MatrixX3d::Zero(structure.particles(), 3);
  SpringForce(structure).add_force(state, expected);
  for (int k = 0; k < 2; ++k) FluidFriction(structure).add_force(state, expected);
  for (const Eigen::Vector3d& g : {gravity, current}) Gravity(structure, g).add_force(state, expected);
  Buoyancy(structure, fish_body, gravity, 0.8).add_force(state, expected);
  WaterForce(structure, {resistance, current}, fish_faces(), first_fish_particle).add_force(state, expected);
  EXPECT_LT((test::force_of(forces, state) - expected).norm(), 1e-13 * expected.norm());
}

}  // namespace
}  // namespace billow::sim
