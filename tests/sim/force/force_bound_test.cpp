// The bound of every law: over K and C wherever it says, and no larger than what they reach.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>

#include "base/random.h"
#include "sim/body/fish.h"
#include "sim/force/forces.h"
#include "sim/force/muscle_force.h"
#include "sim/force/water_force.h"
#include "tests/support/evaluations.h"
#include "tests/support/laws.h"
#include "tests/support/step_matrix.h"
#include "tests/support/structures.h"
#include "tests/support/swimmers.h"

namespace billow::sim {
namespace {

using namespace test::laws;
using test::grid;

Eigen::MatrixXd dense(const StiffnessMatrix& matrix) { return Eigen::MatrixXd(matrix.assemble(false)); }

/// Half the cross product of a face's diagonals: its area [m^2].
double area(const Eigen::MatrixX3d& position, const Face& face) {
  const bool triangle = corner_count(face) == 3;
  const Eigen::Vector3d a = position.row(face[2]) - position.row(face[0]);
  const Eigen::Vector3d b = position.row(face[triangle ? 2 : 3]) - position.row(face[1]);
  return 0.5 * a.cross(b).norm();
}

/// How many times as large as at rest the most grown face is.
double growth(const Case& c, const State& state) {
  double most = 0.0;
  for (const Face& face : c.faces)
    most = std::max(most, area(state.position, face) / area(c.structure->rest_position, face));
  return most;
}

// Turned any way, crumpled, folded through itself, in any motion; faces as large as their bound counts with.
State at_any_shape(const Case& c, double crumpled, std::uint64_t seed) {
  State state = test::shaken_state(*c.structure, crumpled, 3.0, 10 * seed);
  const Eigen::MatrixX3d noise = seeded_noise(2, seed);
  const Eigen::Quaterniond turn = Eigen::Quaterniond(1.0, noise(0, 0), noise(0, 1), noise(0, 2)).normalized();
  state.position = (state.position * turn.toRotationMatrix().transpose()).eval();
  state.time = 3.0 + 3.0 * noise(1, 0);
  if (!c.faces.empty()) state.position *= std::sqrt(WaterForce::largest_growth / growth(c, state));
  return state;
}

State at_rest_shape(const Case& c, std::uint64_t seed) {
  State state = test::shaken_state(*c.structure, 0.0, 3.0, 10 * seed);
  state.time = 3.0 + 3.0 * seeded_noise(1, seed)(0, 0);
  return state;
}

Linearisation bound_of(const Case& c, Shapes shapes) {
  Linearisation bound(*c.structure);
  EXPECT_TRUE(c.law->add_bound(shapes, bound));
  return bound;
}

void expect_within(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& bound) {
  if (matrix.isZero(0.0) && bound.isZero(0.0)) return;
  EXPECT_GE(test::least_eigenvalue(bound - matrix), -1e-9 * (bound.norm() + matrix.norm()));
}

TEST(EveryLaw, NeverExceedsItsBoundAtAnyShape) {
  for_every_law([](const Case& c) {
    const Linearisation bound = bound_of(c, Shapes::any);
    const Eigen::MatrixXd most_stiffness = dense(bound.stiffness), most_damping = dense(bound.damping);
    for (const double crumpled : {0.0, 0.03, 0.3, 100.0})
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        const State state = at_any_shape(c, crumpled, seed);
        expect_within(stiffness(c, state, JacobianForm::definite), most_stiffness);
        expect_within(damping(c, state, JacobianForm::definite), most_damping);
      }
  });
}

TEST(EveryLaw, NeverExceedsItsBoundAtRestWhateverTheMotion) {
  for_every_law([](const Case& c) {
    const Linearisation bound = bound_of(c, Shapes::rest);
    const Eigen::MatrixXd most_stiffness = dense(bound.stiffness), most_damping = dense(bound.damping);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const State state = at_rest_shape(c, seed);
      expect_within(stiffness(c, state, JacobianForm::definite), most_stiffness);
      expect_within(damping(c, state, JacobianForm::definite), most_damping);
    }
  });
}

TEST(EveryLaw, HasABoundAtAnyShapeThatHoldsAtRestToo) {
  for_every_law([](const Case& c) {
    if (c.name.ends_with("muscles")) return;  // at any shape they count with the springs that they are, as below
    const Linearisation any = bound_of(c, Shapes::any), rest = bound_of(c, Shapes::rest);
    expect_within(dense(rest.stiffness), dense(any.stiffness));
    expect_within(dense(rest.damping), dense(any.damping));
  });
}

/// Springs that do not damp and their muscles.
struct Flesh {
  explicit Flesh(const MotionOptions& motion) {
    structure.damping.setZero();
    forces = std::make_unique<Forces>(structure, Eigen::Vector3d::Zero());
    forces->add(std::make_unique<MuscleForce>(structure, fish_body, FishMotion(motion)));
  }
  Eigen::MatrixXd exact_stiffness(const State& state) const {
    return dense(forces->linearise(state, 1.0, 0.0, JacobianForm::exact));
  }
  Eigen::MatrixXd bound(Shapes shapes) const { return dense(forces->bound(shapes).linearisation.stiffness); }
  Structure structure = ring_and_fish();
  std::unique_ptr<Forces> forces;
};

// k (l - L (1 - c)) / l sideways: k c at rest, and below k at any shape. Exactly, where the definite form leaves the
// muscles' own part out.
TEST(MuscleForce, IsNoStifferThanItsBoundCountedWithItsSprings) {
  const Flesh flesh(test::turning(0.6));
  const Eigen::MatrixXd at_rest = flesh.bound(Shapes::rest), at_any = flesh.bound(Shapes::any);
  State state = rest_state(flesh.structure);
  for (state.time = 0.0; state.time < 5.0; state.time += 0.37) expect_within(flesh.exact_stiffness(state), at_rest);
  for (const double crumpled : {0.01, 0.1, 1.0})
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      expect_within(flesh.exact_stiffness(shaken(flesh.structure, seed, crumpled)), at_any);
}

// A bound that is never reached would cost steps for nothing.
TEST(MuscleForce, ReachesItsBoundAtRestWhereEveryMuscleThatTurnsIsContracted) {
  MotionOptions motion;
  motion.keys = {{0.0, 0.0, 0.6, 1.0}};
  const Flesh flesh(motion);
  State state = rest_state(flesh.structure);
  state.time = 1.0;
  const Eigen::MatrixXd bound = flesh.bound(Shapes::rest);
  EXPECT_LT((flesh.exact_stiffness(state) - bound).norm(), 1e-12 * bound.norm());
}

TEST(SpringForce, ReachesItsBoundWhereItIsPulledFarApart) {
  const Case c = springs_of("", sheet(SpringModel::linear, DampingModel::spring), Power::takes);
  State state = rest_state(*c.structure);
  state.position *= 1e7;
  const Linearisation any = bound_of(c, Shapes::any);
  const Eigen::MatrixXd most = dense(any.stiffness);
  EXPECT_LT((stiffness(c, state, JacobianForm::definite) - most).norm(), 1e-6 * most.norm());
  EXPECT_LT((damping(c, state, JacobianForm::definite) - dense(any.damping)).norm(), 1e-12 * most.norm());
}

// The steepest that a beam ever is, it is when bent right over, and then steeper than its straight stiffness.
TEST(SpringForce, ReachesItsBoundWhereABeamIsBentRightOver) {
  Structure beam = grid({.width = 3, .height = 1, .spacing = 0.1, .structural = 0.0, .bend = 30.0});
  beam.body[0].spring_model = SpringModel::choi_ko;
  beam.body[0].buckling_rigidity = 4e-3;
  const Case c = springs_of("", beam, Power::keeps);
  State bent = rest_state(beam);
  bent.position.row(2) = bent.position.row(0) + Eigen::RowVector3d(1e-6, 0.0, 0.0);
  const Eigen::MatrixXd most = dense(bound_of(c, Shapes::any).stiffness);
  EXPECT_GT(most(0, 0), 1.1 * 30.0) << "the test must be able to tell";
  EXPECT_NEAR(stiffness(c, bent, JacobianForm::definite)(0, 0), most(0, 0), 1e-4 * most(0, 0));
}

/// Two faces, a triangle and a quad, that share no corner, pushed squarely.
struct TwoFaces {
  TwoFaces() {
    structure.rest_position.row(6) += Eigen::RowVector3d(0.1, 0.05, -0.2);  // so that one is bent
  }
  State pushed(double size) const {
    State state = rest_state(structure);
    state.position *= size;
    for (const Face& face : faces)
      for (int c = 0; c < corner_count(face); ++c) state.velocity.row(face[c]) = normal(face);
    return state;
  }
  Eigen::RowVector3d normal(const Face& face) const {
    const Eigen::MatrixX3d& x = structure.rest_position;
    const Eigen::Vector3d a = x.row(face[2]) - x.row(face[0]);
    const Eigen::Vector3d b = x.row(face[corner_count(face) == 3 ? 2 : 3]) - x.row(face[1]);
    return a.cross(b).transpose().normalized();
  }
  Structure structure = grid({.width = 4, .height = 2, .spacing = 0.1});
  std::vector<Face> faces = {{0, 4, 5, -1}, {2, 6, 7, 3}};
  WaterForce water{structure, {resistance, Eigen::Vector3d::Zero()}, faces, 0};
};

// F = -c A (n . v) n: pushed at 1 m/s along its normal, a face of area A takes the power c A. v . C v is the same.
TEST(WaterForce, TakesAFacesAreaTimesItsResistance) {
  const TwoFaces two;
  const State state = two.pushed(1.0);
  double expected = 0.0;
  for (const Face& face : two.faces) expected += resistance * area(state.position, face);
  EXPECT_NEAR(-test::force_of(two.water, state).cwiseProduct(state.velocity).sum(), expected, 1e-12 * expected);
}

// At rest C itself, and at any shape v . C v of a face that has grown as far as the bound counts with.
TEST(WaterForce, ReachesItsBoundWhereAFaceIsPushedSquarely) {
  const TwoFaces two;
  const auto quadratic = [](const Eigen::MatrixXd& matrix, const State& state) {
    const Eigen::VectorXd v = state.velocity.transpose().reshaped();
    return v.dot(matrix * v);
  };
  const auto damping_at = [&](const State& state) {
    StiffnessMatrix matrix(two.structure);
    two.water.add_linearisation(state, 0.0, 1.0, JacobianForm::definite, matrix);
    return dense(matrix);
  };
  Linearisation rest(two.structure), any(two.structure);
  two.water.add_bound(Shapes::rest, rest), two.water.add_bound(Shapes::any, any);
  const Eigen::MatrixXd still = damping_at(two.pushed(1.0));
  EXPECT_LT((dense(rest.damping) - still).norm(), 1e-14 * still.norm());
  const State grown = two.pushed(std::sqrt(WaterForce::largest_growth));
  const double most = quadratic(dense(any.damping), grown);
  EXPECT_NEAR(quadratic(damping_at(grown), grown), most, 1e-12 * most);
}

}  // namespace
}  // namespace billow::sim
