// Every row of the table of exact limits against the dense eigenvalues of the step that it speaks of.
#include "sim/limit/exact_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "sim/force/fluid_friction.h"
#include "sim/force/spring_force.h"
#include "sim/linear/max_eigenvalue.h"
#include "sim/step/step.h"
#include "tests/support/evaluations.h"
#include "tests/support/ring_of_modes.h"
#include "tests/support/step_matrix.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::grid;

/// A small sheet without any symmetry to help: uneven masses and springs.
Structure crooked_sheet(std::vector<int> pinned) {
  Structure structure = test::with_uneven_masses(grid({.width = 4,
                                                       .height = 3,
                                                       .spacing = 0.1,
                                                       .mass = 0.02,
                                                       .structural = 90.0,
                                                       .shear = 60.0,
                                                       .bend = 25.0,
                                                       .pinned = std::move(pinned)}),
                                                 0.5);
  for (int s = 0; s < structure.springs(); ++s) structure.stiffness(s) *= 1.0 + 0.3 * std::sin(3.0 * s);
  return structure;
}

/// Damping that shares no eigenvector with the stiffness.
Structure unevenly_damped(Structure structure, double coefficient, double friction) {
  for (int s = 0; s < structure.springs(); ++s)
    structure.damping(s) = coefficient * (1.0 + 0.8 * std::sin(5.0 * s + 1.0));
  structure.body[0].friction = friction;
  return structure;
}

struct Subject {
  Structure structure;
  Linearisation linearisation{structure};
  std::optional<Filter> filter;
  Method method = Method::fb_euler;

  Subject(Structure built, Method scheme, std::optional<FilterTarget> target = std::nullopt)
      : structure(std::move(built)), linearisation(linearise_at_rest(structure)), method(scheme) {
    if (target) filter.emplace(structure, FilterOptions{.form = FilterForm::conserving, .target = *target});
  }
  LinearisedStep step() const {
    return {structure, linearisation, structure.rest_position, method, {}, filter ? &*filter : nullptr};
  }
  double radius(double h) const {
    const Forces forces = linear_forces(structure, linearisation);
    Step run(forces, method, {.linear_solver = LinearSolver::cholesky}, filter ? &*filter : nullptr,
             &structure.rest_position);
    const double k0 = max_eigenvalue(structure, linearisation.stiffness).value;
    return test::spectral_radius(test::step_matrix(structure, std::ref(run), h, 1.0 / std::sqrt(k0)));
  }
};

// Eigenvalues on the unit circle come in defective pairs for free bodies, which rounding moves by its square root.
constexpr double rounding = 2e-7;

void expect_stable_up_to(const Subject& subject, double limit) {
  for (const double share : {0.4, 1.0})
    EXPECT_LE(subject.radius(share * limit), 1.0 + rounding) << share << " of " << limit;
}

/// No step up to the limit grows, and one beyond it by `slack` does.
void expect_tight(const Subject& subject, double slack = 1e-3) {
  const auto found = exact_limit(subject.step());
  ASSERT_TRUE(found && found->exact && !found->unlimited);
  expect_stable_up_to(subject, found->step);
  EXPECT_GT(subject.radius((1.0 + slack) * found->step), 1.0 + 1e-5) << found->step;
}

const std::vector<int> held{0, 3}, free_of_pins{};

TEST(ExactLimit, IsTightForFBEulerAndVerletWithAndWithoutAFilterAndDamping) {
  for (const auto& pinned : {held, free_of_pins})
    for (const double damping : {0.0, 0.3})
      for (const Method method : {Method::fb_euler, Method::verlet})
        for (const std::optional<FilterTarget> target :
             {std::optional<FilterTarget>{}, std::optional(FilterTarget::force),
              std::optional(FilterTarget::velocity)}) {
          SCOPED_TRACE(testing::Message() << name(method) << ", " << pinned.size() << " pins, damping " << damping
                                          << ", target " << (target ? static_cast<int>(*target) : -1));
          expect_tight({unevenly_damped(crooked_sheet(pinned), damping, 0.2 * damping), method, target});
        }
}

TEST(ExactLimit, IsTwoRootTwoForRungeKuttaWithoutDamping) {
  for (const auto& pinned : {held, free_of_pins}) {
    const Subject plain(crooked_sheet(pinned), Method::rk4);
    expect_tight(plain);
    const double k0 = max_eigenvalue(plain.structure, plain.linearisation.stiffness).value;
    EXPECT_NEAR(exact_limit(plain.step())->step, 2.0 * std::numbers::sqrt2 / std::sqrt(k0), 1e-4 / std::sqrt(k0));
    expect_tight({crooked_sheet(pinned), Method::rk4, FilterTarget::force});
  }
}

// With damping it is on the safe side: no mode need have the largest stiffness and the largest damping at once.
TEST(ExactLimit, HoldsForRungeKuttaWithDamping) {
  for (const double damping : {0.02, 3.0})
    for (const std::optional<FilterTarget> target :
         {std::optional<FilterTarget>{}, std::optional(FilterTarget::force)}) {
      const Subject subject(unevenly_damped(crooked_sheet(held), damping, 0.1), Method::rk4, target);
      const auto found = exact_limit(subject.step());
      ASSERT_TRUE(found && !found->unlimited);
      expect_stable_up_to(subject, found->step);
      EXPECT_GT(subject.radius(1.6 * found->step), 1.0 + 1e-3) << damping;
    }
}

// x'' = -omega^2 x - gamma x': forward Euler is stable iff h <= gamma / omega^2 and (2 - gamma h)^2 ... <= 4.
TEST(ExactLimit, OfForwardEulerIsDampingOverStiffness) {
  test::RingOfModes ring;
  const double omega = ring.omega(test::RingOfModes::n / 2);
  for (const double gamma : {0.05 * omega, 0.7 * omega, 1.4 * omega}) {
    ring.structure.body[0].friction = gamma * test::RingOfModes::mass;
    const Linearisation linearisation = test::bound_of(ring.structure, Shapes::any);
    const auto found =
        exact_limit({ring.structure, linearisation, ring.structure.rest_position, Method::forward_euler});
    ASSERT_TRUE(found);
    const double expected = std::min(gamma / (omega * omega), 2.0 / gamma);
    EXPECT_NEAR(found->step, expected, 2e-2 * expected) << gamma / omega;  // what is tolerated in 10 s shows
  }
}

TEST(ExactLimit, HoldsForForwardEulerWithADampingOfEveryKind) {
  for (const DampingModel model : {DampingModel::projected, DampingModel::spring})
    for (const double friction : {0.5, 20.0})
      for (const std::optional<FilterTarget> target :
           {std::optional<FilterTarget>{}, std::optional(FilterTarget::force)}) {
        Structure structure = unevenly_damped(crooked_sheet(held), 0.2, friction);
        structure.body[0].damping_model = model;
        const Subject subject(std::move(structure), Method::forward_euler, target);
        const auto found = exact_limit(subject.step());
        ASSERT_TRUE(found && found->step > 0.0);
        SCOPED_TRACE(testing::Message() << static_cast<int>(model) << ", friction " << friction << ", target "
                                        << (target ? static_cast<int>(*target) : -1));
        for (const double share : {0.1, 0.5, 1.0})  // 0.02 a second are tolerated
          EXPECT_LE(subject.radius(share * found->step), 1.0 + 0.02 * found->step + rounding) << found->step;
      }
}

TEST(ExactLimit, IsNothingForForwardEulerWithoutDamping) {
  EXPECT_EQ(exact_limit(Subject(crooked_sheet(held), Method::forward_euler).step())->step, 0.0);
}

// At any shape the damping along a spring may have nothing to say about a motion across it.
TEST(ExactLimit, OfForwardEulerGoesByTheLeastDampingAtAnyShape) {
  Structure structure = crooked_sheet(held);
  structure.damping.setConstant(0.5);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  const Linearisation any = forces.bound(Shapes::any).linearisation;
  const StiffnessMatrix least = forces.least_damping();
  LinearisedStep step{structure, any, structure.rest_position, Method::forward_euler};
  step.least_damping = &least;
  EXPECT_EQ(exact_limit(step)->step, 0.0);
  structure.body[0].friction = 2.0;
  const Linearisation with_friction = forces.bound(Shapes::any).linearisation;
  const StiffnessMatrix least_with_friction = forces.least_damping();
  const LinearisedStep again{structure, with_friction, structure.rest_position, Method::forward_euler, {},
                             nullptr,   10.0,          &least_with_friction};
  EXPECT_GT(exact_limit(again)->step, 0.0);
  EXPECT_LT(
      exact_limit(again)->step,
      exact_limit(LinearisedStep{structure, with_friction, structure.rest_position, Method::forward_euler})->step);
}

TEST(ExactLimit, IsNoneForTheImplicitSchemesWithoutAFilter) {
  for (const Method method : {Method::backward_euler, Method::imex}) {
    const Subject subject(unevenly_damped(crooked_sheet(held), 0.3, 0.1), method);
    EXPECT_TRUE(exact_limit(subject.step())->unlimited) << name(method);
    EXPECT_LE(subject.radius(1.0), 1.0 + rounding);
  }
}

// What acts besides the springs is explicit in IMEX: friction that it does not know of, c h <= 2 m.
TEST(ExactLimit, OfIMEXCountsWhatItDoesNotTakeImplicitly) {
  Subject subject(crooked_sheet(held), Method::imex);
  for (int i = 0; i < subject.structure.particles(); ++i) subject.linearisation.damping.add_diagonal(i, 30.0);
  expect_tight(subject, 2e-3);
  EXPECT_NEAR(exact_limit(subject.step())->step, 2.0 * subject.structure.mass.minCoeff() / 30.0, 0.02);
}

TEST(ExactLimit, LeavesWhatHasNoClosedFormToTrials) {
  for (const FilterForm form : {FilterForm::plain, FilterForm::symmetric}) {
    Subject subject(crooked_sheet(held), Method::fb_euler);
    subject.filter.emplace(subject.structure, FilterOptions{.form = form});
    EXPECT_FALSE(exact_limit(subject.step()));
  }
  for (const Method method : {Method::forward_euler, Method::rk4, Method::backward_euler})
    EXPECT_FALSE(exact_limit(Subject(crooked_sheet(held), method, FilterTarget::velocity).step())) << name(method);
}

// On a ring of equal masses plain weights are self-adjoint, so they need no trial.
TEST(ExactLimit, TakesAnyFormThatIsSelfAdjoint) {
  const test::RingOfModes ring;
  for (const FilterForm form : {FilterForm::plain, FilterForm::symmetric}) {
    const Filter filter(ring.structure, {.lambda = 2.0, .form = form});
    const auto found =
        exact_limit({ring.structure, ring.linearisation, ring.structure.rest_position, Method::fb_euler, {}, &filter});
    ASSERT_TRUE(found);
    EXPECT_GT(found->step, 2.0 / ring.omega(test::RingOfModes::n / 2));
  }
}

// F M^-1 K(x) at random shapes is never beyond what the mean filter says for the stiffest that any shape can be.
TEST(MeanFilterLimit, BoundsForceFiltersAtEveryShape) {
  const Structure structure = crooked_sheet(held);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  const Linearisation any = forces.bound(Shapes::any).linearisation;
  for (const FilterForm form : {FilterForm::plain, FilterForm::symmetric}) {
    const Filter filter(structure, {.lambda = 4.0, .form = form, .target = FilterTarget::force});
    const LinearisedStep step{structure, any, structure.rest_position, Method::fb_euler, {}, &filter};
    const auto bound = limit_of_mean_filter(step);
    ASSERT_TRUE(bound);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      const State shape = test::shaken_state(structure, 0.03 * (1 + seed % 4), 0.0, seed);
      Linearisation at(structure);
      forces.linearise(shape, 1.0, 0.0, JacobianForm::definite, at.stiffness);
      const Forces linear = linear_forces(structure, at);
      Step run(linear, Method::fb_euler, {}, &filter, &structure.rest_position);
      const double k0 = max_eigenvalue(structure, any.stiffness).value;
      EXPECT_LE(test::spectral_radius(test::step_matrix(structure, std::ref(run), bound->step, 1.0 / std::sqrt(k0))),
                1.0 + 1e-3)
          << seed;
    }
  }
}

TEST(TurnedMotions, AreThoseOfFiltersWithNegativeResponses) {
  const test::RingOfModes ring;
  const auto turns = [&](const FilterOptions& options) {
    const Filter filter(ring.structure, options);
    return turns_motions_around(
        {ring.structure, ring.linearisation, ring.structure.rest_position, Method::fb_euler, {}, &filter});
  };
  EXPECT_TRUE(turns({.lambda = 0.5}));
  EXPECT_FALSE(turns({.lambda = 0.5, .form = FilterForm::symmetric}));
  EXPECT_FALSE(turns({.lambda = 0.5, .form = FilterForm::conserving}));
  EXPECT_FALSE(turns({.lambda = 3.0}));
}

}  // namespace
}  // namespace billow::sim
