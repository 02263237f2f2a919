// Every law of force against what it says of itself: energy, Jacobians, bound and passivity, in one table for all.
#include "sim/force/force_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <memory>

#include "base/random.h"
#include "sim/force/buoyancy.h"
#include "sim/force/fluid_friction.h"
#include "sim/force/gravity.h"
#include "sim/force/muscle_force.h"
#include "sim/force/spring_force.h"
#include "sim/force/water_force.h"
#include "sim/limit/linear_force.h"
#include "tests/support/evaluations.h"
#include "tests/support/step_matrix.h"
#include "tests/support/structures.h"
#include "tests/support/swimmers.h"

namespace billow::sim {
namespace {

using test::grid;
using test::least_eigenvalue;
using test::with_uneven_masses;

const Eigen::Vector3d gravity(1.0, -9.81, 0.5), current(0.3, -0.1, 0.2);
constexpr double resistance = 580.0;

/// What a law does to the energy of the motion, its own potential energy counted.
enum class Power { keeps, takes, gives };

/// A law on a structure that it acts on, and what is true of it.
struct Case {
  std::string name;
  std::shared_ptr<const Structure> structure;
  std::shared_ptr<const ForceLaw> law;
  Power power;
  std::vector<Face> faces = {};  // whose growth bounds the shapes that its bound is for
};

using Maker = std::function<std::shared_ptr<const ForceLaw>(const Structure&)>;

Case make(const std::string& name, const Structure& structure, Power power, const Maker& maker) {
  const auto shared = std::make_shared<const Structure>(structure);
  return {name, shared, maker(*shared), power};
}

Structure sheet(SpringModel model, DampingModel damping) {
  Structure structure =
      grid({.width = 4, .height = 3, .spacing = 0.1, .mass = 0.02, .structural = 100.0, .shear = 70.0, .bend = 30.0});
  structure.damping = Eigen::VectorXd::LinSpaced(structure.springs(), 0.0, 2.0);
  structure.body[0].spring_model = model;
  structure.body[0].damping_model = damping;
  structure.body[0].buckling_rigidity = 4e-3;
  structure.body[0].friction = 0.3;
  return with_uneven_masses(structure, 0.5);
}

// A fish that is not the first body, so that what it counts from is seen.
Structure ring_and_fish() {
  Structure whole = merge({test::ring(5, 0.4, 30.0), build_fish(test::swimmer_options())});
  whole.body[0].friction = 0.2;
  whole.body[1].friction = 0.05;
  return whole;
}
constexpr int fish_body = 1, first_fish_particle = 5;

std::vector<Face> fish_faces_in_the_whole() {
  std::vector<Face> faces = fish_faces();
  for (Face& face : faces)
    for (int c = 0; c < corner_count(face); ++c) face[c] += first_fish_particle;
  return faces;
}

std::shared_ptr<const ForceLaw> springs(const Structure& s) { return std::make_shared<SpringForce>(s); }

Case spring_case(const std::string& name, SpringModel model, DampingModel damping) {
  return make(name, sheet(model, damping), Power::takes, springs);
}

Case muscle_case(const std::string& name, const MotionOptions& motion, Power power) {
  return make(name, ring_and_fish(), power,
              [&](const Structure& s) { return std::make_shared<MuscleForce>(s, fish_body, FishMotion(motion)); });
}

Case water_case(const std::string& name, const Eigen::Vector3d& velocity, Power power) {
  Case water = make(name, ring_and_fish(), power, [&](const Structure& s) {
    return std::make_shared<WaterForce>(s, Water{resistance, velocity}, fish_faces(), first_fish_particle);
  });
  water.faces = fish_faces_in_the_whole();
  return water;
}

// It refers to a linearisation, which lives as long as it does.
Case linearised_case() {
  return make("linearised springs", sheet(SpringModel::linear, DampingModel::projected), Power::takes,
              [](const Structure& s) -> std::shared_ptr<const ForceLaw> {
                struct Owner {
                  explicit Owner(const Structure& s) : linearisation(linearise_at_rest(s)), law(linearisation) {}
                  Linearisation linearisation;
                  LinearForce law;
                };
                const auto owner = std::make_shared<const Owner>(s);
                return {owner, &owner->law};
              });
}

const std::vector<Case>& cases() {
  static const std::vector<Case> list = {
      spring_case("springs, projected damping", SpringModel::linear, DampingModel::projected),
      spring_case("springs, relative damping", SpringModel::linear, DampingModel::spring),
      spring_case("Choi-Ko springs, projected damping", SpringModel::choi_ko, DampingModel::projected),
      make("friction", ring_and_fish(), Power::takes,
           [](const Structure& s) { return std::make_shared<FluidFriction>(s); }),
      make("gravity", ring_and_fish(), Power::keeps,
           [](const Structure& s) { return std::make_shared<Gravity>(s, gravity); }),
      make("buoyancy", ring_and_fish(), Power::keeps,
           [](const Structure& s) { return std::make_shared<Buoyancy>(s, fish_body, gravity, 0.8); }),
      muscle_case("swimming muscles", test::swimming(), Power::gives),
      muscle_case("turning muscles", test::turning(0.4), Power::gives),
      muscle_case("still muscles", {}, Power::keeps),
      water_case("still water", Eigen::Vector3d::Zero(), Power::takes),
      water_case("a current", current, Power::gives),
      linearised_case(),
  };
  return list;
}

template <class Check>
void for_every_law(const Check& check) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    check(c);
  }
}

// Everything moves, and a fish is somewhere in its swimming and turning.
State shaken(const Structure& structure, std::uint64_t seed, double distance = 0.02) {
  State state = test::shaken_state(structure, distance, 0.5, 10 * seed);
  state.time = 2.7 + 0.37 * static_cast<double>(seed);
  return state;
}

/// x + share v, as time goes on.
State moved(State state, double share) {
  state.position += share * state.velocity;
  state.time += share;
  return state;
}

Eigen::MatrixX3d minus_energy_gradient(const ForceLaw& law, State state, double d) {
  Eigen::MatrixX3d gradient(state.position.rows(), 3);
  for (int c = 0; c < gradient.size(); ++c) {
    double& x = state.position.data()[c];
    const double here = x;
    x = here + d;
    const double above = law.energy(state);
    x = here - d;
    gradient.data()[c] = (law.energy(state) - above) / (2.0 * d);
    x = here;
  }
  return gradient;
}

// Nothing moves: what is left of a force is that of its potential. A current pushes all the same.
TEST(EveryLaw, PullsDownItsPotentialEnergy) {
  for_every_law([](const Case& c) {
    if (c.name == "a current") return;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      State state = shaken(*c.structure, seed);
      state.velocity.setZero();
      const Eigen::MatrixX3d force = test::force_of(*c.law, state);
      EXPECT_LE((force - minus_energy_gradient(*c.law, state, 1e-6)).norm(), 1e-6 * force.norm());
    }
  });
}

// Column 3 i + axis: minus the change of the force with one entry of the position or the velocity.
Eigen::MatrixXd minus_slope(const ForceLaw& law, State state, Eigen::MatrixX3d State::*field, double d) {
  const int size = static_cast<int>(state.position.size());
  Eigen::MatrixXd slope(size, size);
  for (int column = 0; column < size; ++column) {
    double& entry = (state.*field)(column / 3, column % 3);
    const double here = entry;
    entry = here + d;
    const Eigen::MatrixX3d above = test::force_of(law, state);
    entry = here - d;
    const Eigen::MatrixX3d below = test::force_of(law, state);
    entry = here;
    slope.col(column) = (below - above).transpose().reshaped() / (2.0 * d);
  }
  return slope;
}

Eigen::MatrixXd dense(const StiffnessMatrix& matrix) { return Eigen::MatrixXd(matrix.assemble(false)); }

Eigen::MatrixXd linearised(const Case& c, const State& state, double position_weight, double velocity_weight,
                           JacobianForm form) {
  StiffnessMatrix matrix(*c.structure);
  c.law->add_linearisation(state, position_weight, velocity_weight, form, matrix);
  return dense(matrix);
}

Eigen::MatrixXd stiffness(const Case& c, const State& state, JacobianForm form) {
  return linearised(c, state, 1.0, 0.0, form);
}

Eigen::MatrixXd damping(const Case& c, const State& state, JacobianForm form) {
  return linearised(c, state, 0.0, 1.0, form);
}

// How damping and pressure turn with what they act along included: the exact form is the whole of it.
TEST(EveryLaw, LinearisesExactlyToMinusTheSlopeOfItsForce) {
  for_every_law([](const Case& c) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const State state = shaken(*c.structure, seed);
      const Eigen::MatrixXd by_position = minus_slope(*c.law, state, &State::position, 1e-6);
      const Eigen::MatrixXd by_velocity = minus_slope(*c.law, state, &State::velocity, 1e-6);
      EXPECT_LE((stiffness(c, state, JacobianForm::exact) - by_position).norm(), 1e-6 * by_position.norm());
      EXPECT_LE((damping(c, state, JacobianForm::exact) - by_velocity).norm(), 1e-7 * by_velocity.norm());
      const Eigen::MatrixXd both = 0.3 * by_position + 0.02 * by_velocity;
      EXPECT_LE((linearised(c, state, 0.3, 0.02, JacobianForm::exact) - both).norm(), 1e-6 * both.norm());
    }
  });
}

// Pulled apart and pushed together: what may be dropped from K is dropped only there, and nothing from C.
TEST(EveryLaw, HasADefiniteFormThatIsSymmetricWithoutANegativeEigenvalue) {
  for_every_law([](const Case& c) {
    for (const double size : {0.3, 1.7}) {
      State state = shaken(*c.structure, 4);
      state.position *= size;
      for (const auto& [k, d] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {0.1, 2.0}}) {
        const Eigen::MatrixXd definite = linearised(c, state, k, d, JacobianForm::definite);
        EXPECT_LE((definite - definite.transpose()).norm(), 1e-14 * definite.norm());
        EXPECT_GE(least_eigenvalue(definite), -1e-12 * definite.norm());
      }
      EXPECT_EQ(damping(c, state, JacobianForm::definite), damping(c, state, JacobianForm::exact));
    }
  });
}

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
  EXPECT_GE(least_eigenvalue(bound - matrix), -1e-9 * (bound.norm() + matrix.norm()));
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
  const Case c = spring_case("", SpringModel::linear, DampingModel::spring);
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
  const Case c = make("", beam, Power::keeps, springs);
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

/// Force times velocity [W] plus how fast the law's own potential energy grows, over the scale of the first.
double relative_power(const Case& c, const State& state) {
  constexpr double d = 1e-6;
  const Eigen::MatrixX3d force = test::force_of(*c.law, state);
  const double stored = (c.law->energy(moved(state, d)) - c.law->energy(moved(state, -d))) / (2.0 * d);
  const double scale = force.norm() * state.velocity.norm();
  return scale > 0.0 ? (force.cwiseProduct(state.velocity).sum() + stored) / scale : 0.0;
}

TEST(EveryLaw, TakesEnergyOrKeepsItWhereItSaysThatItIsPassiveAndElseGivesSome) {
  for_every_law([](const Case& c) {
    EXPECT_EQ(c.law->passive(), c.power != Power::gives);
    double least = 0.0, most = -1.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const double power = relative_power(c, shaken(*c.structure, seed));
      least = std::min(least, power), most = std::max(most, power);
    }
    if (c.power == Power::gives)
      EXPECT_GT(most, 1e-3);
    else if (c.power == Power::takes)
      EXPECT_LT(most, -1e-3);
    else
      EXPECT_LT(std::max(most, -least), 1e-7);
  });
}

// Whichever place its body has in the whole, a law of one body does to it what it would do alone, and nothing to
// others.
TEST(LawOfABody, ActsOnItAsIfItWereAlone) {
  const Structure alone = build_fish(test::swimmer_options()), whole = ring_and_fish();
  const FishMotion motion(test::turning(0.4));
  const Water water{resistance, current};
  const auto pairs = {
      std::pair<std::shared_ptr<ForceLaw>, std::shared_ptr<ForceLaw>>{
          std::make_shared<MuscleForce>(alone, 0, motion), std::make_shared<MuscleForce>(whole, fish_body, motion)},
      {std::make_shared<WaterForce>(alone, water, fish_faces(), 0),
       std::make_shared<WaterForce>(whole, water, fish_faces(), first_fish_particle)},
      {std::make_shared<Buoyancy>(alone, 0, gravity, 0.8), std::make_shared<Buoyancy>(whole, fish_body, gravity, 0.8)}};
  const State state = shaken(whole, 3);
  const int n = alone.particles();
  const State fish{state.position.bottomRows(n), state.velocity.bottomRows(n), state.time};
  for (const auto& [law, in_the_whole] : pairs) {
    SCOPED_TRACE(law->name());
    const Eigen::MatrixX3d force = test::force_of(*in_the_whole, state);
    EXPECT_TRUE(force.topRows(first_fish_particle).isZero(0.0));
    EXPECT_EQ(force.bottomRows(n), test::force_of(*law, fish));
    EXPECT_NEAR(in_the_whole->energy(state), law->energy(fish), 1e-12);
  }
}

TEST(EveryLaw, AddsToWhatIsThere) {
  for_every_law([](const Case& c) {
    const State state = shaken(*c.structure, 1);
    const Eigen::MatrixX3d before = seeded_noise(c.structure->particles(), 3), alone = test::force_of(*c.law, state);
    Eigen::MatrixX3d sum = before;
    c.law->add_force(state, sum);
    EXPECT_LE((sum - (before + alone)).norm(), 1e-14 * (before.norm() + alone.norm()));
  });
}

/// Pushes on and on, and has no bound.
class Thrust : public ForceLaw {
 public:
  std::string_view name() const override { return "the thrust"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override { force += state.velocity; }
  double energy(const State&) const override { return 0.0; }
  void add_linearisation(const State&, double, double, JacobianForm, StiffnessMatrix&) const override {}
  bool add_bound(Shapes, Linearisation&) const override { return false; }
  bool passive() const override { return false; }
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
    const Linearisation expected =
        shapes == Shapes::rest ? linearise_at_rest(structure) : linearise_any_shape(structure);
    EXPECT_EQ(dense(bound.linearisation.stiffness), dense(expected.stiffness));
    EXPECT_EQ(dense(bound.linearisation.damping), dense(expected.damping));
  }
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
