// The certificate: closed forms where filter and springs commute, dense eigenvalues where not.
#include "sim/limit/certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "sim/body/momenta.h"
#include "sim/force/spring_force.h"
#include "sim/limit/filtered_eigenvalue.h"
#include "sim/limit/paper_step.h"
#include "sim/limit/stiffness_scale.h"
#include "sim/linear/max_eigenvalue.h"
#include "sim/step/step.h"
#include "tests/support/evaluations.h"
#include "tests/support/ring_of_modes.h"
#include "tests/support/step_matrix.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::bound_of;
using test::grid;
using test::with_uneven_masses;
using Ring = test::RingOfModes;

CertifiedStep certified(const Structure& structure, const Linearisation& linearisation, Method method,
                        const Filter* filter) {
  return certified_step({structure, linearisation, structure.rest_position, method, {}, filter});
}

CertifiedStep certified_at_rest(const Structure& structure, Method method, const Filter* filter) {
  return certified(structure, linearise_at_rest(structure), method, filter);
}

TEST(Certificate, FindsTheLeastOfTheRingsLimits) {
  const Ring ring;
  for (const FilterTarget target : {FilterTarget::force, FilterTarget::velocity})
    for (const FilterOptions& options : test::filters_that_pass_every_mode_upright(target)) {
      double least = HUGE_VAL;
      for (int p = 1; p <= Ring::n / 2; ++p) {
        const double g = ring.response(options, p);
        least =
            std::min(least, std::sqrt(target == FilterTarget::force ? 4.0 / g : 2.0 * (1.0 + g) / g) / ring.omega(p));
      }
      const Filter filter(ring.structure, options);
      for (const Method method : {Method::fb_euler, Method::verlet})
        EXPECT_NEAR(certified(ring.structure, ring.linearisation, method, &filter).step, least, 0.002 * least)
            << name(method) << ", lambda = " << options.lambda;
    }
}

TEST(Certificate, GivesNothingToAFilterThatTurnsModesAround) {
  const Ring ring;
  const double unit = 2.0 / ring.omega(Ring::n / 2);
  const Filter force(ring.structure, {.lambda = 0.5, .target = FilterTarget::force});
  EXPECT_EQ(certified(ring.structure, ring.linearisation, Method::fb_euler, &force).step, 0.0);
  // Growth in a velocity filter is of second order in h, so it drowns in the tolerance of the smallest steps.
  const Filter velocity(ring.structure, {.lambda = 0.5});
  EXPECT_LT(certified(ring.structure, ring.linearisation, Method::fb_euler, &velocity).step, 0.1 * unit);
}

// With friction, x'' = -omega^2 x - gamma x' is stable under FB Euler iff omega^2 h^2 + 2 gamma h <= 4, and under
// forward Euler iff h <= gamma / omega^2 (while gamma h <= 2). Forward Euler then grows so slowly that what is
// tolerated shows.
TEST(Certificate, KnowsWhatFrictionCostsFBEulerAndGivesForwardEuler) {
  Ring ring;
  const double omega = ring.omega(Ring::n / 2);
  for (const double gamma : {0.4 * omega, 0.7 * omega, 1.0 * omega}) {
    ring.structure.body[0].friction = gamma * Ring::mass;
    const Linearisation linearisation = bound_of(ring.structure, Shapes::any);
    const double symplectic = (std::sqrt(gamma * gamma + 4.0 * omega * omega) - gamma) / (omega * omega);
    const double explicit_euler = gamma / (omega * omega);
    EXPECT_NEAR(certified(ring.structure, linearisation, Method::fb_euler, nullptr).step, symplectic,
                0.002 * symplectic);
    EXPECT_NEAR(certified(ring.structure, linearisation, Method::forward_euler, nullptr).step, explicit_euler,
                0.01 * explicit_euler);
  }
}

// Friction alone acts on a free body as a whole: gamma h <= 2.
TEST(Certificate, SeesMotionsThatOnlyDampingActsOn) {
  Ring ring;
  const double omega = ring.omega(Ring::n / 2), gamma = 6.0 * omega;
  ring.structure.body[0].friction = gamma * Ring::mass;
  EXPECT_NEAR(certified(ring.structure, linearise_at_rest(ring.structure), Method::forward_euler, nullptr).step,
              2.0 / gamma, 0.002 * 2.0 / gamma);
}

/// A small sheet without any symmetry to help.
Structure crooked_sheet(std::vector<int> pinned) {
  Structure structure = with_uneven_masses(grid({.width = 4,
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

struct Case {
  Method method;
  std::optional<FilterOptions> filter;
};

std::vector<Case> explicit_cases() {
  std::vector<Case> cases;
  for (const Method method : {Method::forward_euler, Method::fb_euler, Method::verlet, Method::rk4}) {
    cases.push_back({method, std::nullopt});
    for (const FilterTarget target : {FilterTarget::velocity, FilterTarget::force})
      for (const FilterForm form : {FilterForm::plain, FilterForm::symmetric, FilterForm::conserving})
        cases.push_back({method, FilterOptions{.form = form, .target = target}});
  }
  return cases;
}

// What a step of h may grow by: nothing but rounding by eigenvalues, and what comes to e^6 in ten seconds by trials.
double tolerated(double h, bool exact, double duration = 10.0) {
  return 1e-6 + (exact ? 0.2 : 4.0 * CertificateOptions{}.tolerated_growth) / duration * h;
}

// The certificate against eigenvalues of the step's matrix: stable up to it, unstable just beyond.
void expect_certified_by_eigenvalues(const Structure& structure, const Case& c) {
  const Linearisation linearisation = linearise_at_rest(structure);
  const Forces forces = linear_forces(structure, linearisation);
  const std::optional<Filter> filter = c.filter ? std::make_optional<Filter>(structure, *c.filter) : std::nullopt;
  const Filter* f = filter ? &*filter : nullptr;
  Step step(forces, c.method, {}, f, &structure.rest_position);
  const double unit = 2.0 / std::sqrt(max_eigenvalue(structure, linearisation.stiffness).value);
  const auto radius = [&](double h) {
    return test::spectral_radius(test::step_matrix(structure, std::ref(step), h, 0.5 * unit));
  };
  const CertifiedStep result = certified(structure, linearisation, c.method, f);
  ASSERT_FALSE(result.unlimited);
  for (const double share : {0.5, 1.0})
    EXPECT_LE(radius(share * result.step), 1.0 + tolerated(share * result.step, result.exact))
        << share << " of " << result.step / unit << " units";
  // Where A and C do not commute, forward Euler's and RK4's closed forms are on the safe side.
  const bool sufficient =
      result.exact && !linearisation.damping.is_zero() && !(c.method == Method::fb_euler || c.method == Method::verlet);
  const double beyond = result.step > 0.0 ? (sufficient ? 1.7 : 1.01) * result.step : 0.06 * unit;
  EXPECT_GT(radius(beyond), 1.0 + 1e-6) << result.step / unit << " units";
}

TEST(Certificate, AgreesWithDenseEigenvaluesForEveryExplicitSchemeAndFilter) {
  for (const std::vector<int>& pinned : {std::vector<int>{0, 3}, {}}) {
    const Structure structure = crooked_sheet(pinned);
    for (const Case& c : explicit_cases()) {
      SCOPED_TRACE(testing::Message() << name(c.method) << ", " << pinned.size() << " pins, filter "
                                      << (c.filter ? static_cast<int>(c.filter->form) : -1) << " of target "
                                      << (c.filter ? static_cast<int>(c.filter->target) : -1));
      expect_certified_by_eigenvalues(structure, c);
    }
  }
}

TEST(Certificate, AgreesWithDenseEigenvaluesWithDamping) {
  for (const DampingModel model : {DampingModel::projected, DampingModel::spring}) {
    Structure structure = crooked_sheet({0, 3});
    structure.damping.setConstant(0.4);
    structure.body[0].damping_model = model;
    structure.body[0].friction = 0.1;
    for (const Case& c : explicit_cases()) {
      if (c.filter && c.filter->form != FilterForm::symmetric) continue;
      SCOPED_TRACE(testing::Message() << name(c.method) << ", damping " << static_cast<int>(model) << ", target "
                                      << (c.filter ? static_cast<int>(c.filter->target) : -1));
      expect_certified_by_eigenvalues(structure, c);
    }
  }
}

// RK4 turns a motion that grows by epsilon z a step, z = omega h, into one that grows by about epsilon z - z^6 / 144:
// not at all at large steps. On uneven springs with an uneven lambda, F M^-1 K has complex eigenvalues, and its mode
// grows at half of the step that is stable by itself.
TEST(Certificate, AgreesWithDenseEigenvaluesWhereRungeKuttaGrowsAtSmallerStepsOnly) {
  Structure structure = test::ring(6, 1.0, 1.0);
  FilterOptions options{.target = FilterTarget::force, .particle_lambda = Eigen::VectorXd(6)};
  for (int i = 0; i < 6; ++i) {
    structure.stiffness(i) = 1.0 + 0.9 * std::sin(7.0 * i);
    options.particle_lambda(i) = 1.0 + 0.9 * std::sin(4.0 * i);
  }
  const Filter filter(structure, options);
  const Linearisation linearisation = bound_of(structure, Shapes::any);
  const Forces forces = linear_forces(structure, linearisation);
  Step step(forces, Method::rk4, {}, &filter, &structure.rest_position);
  const double unit = 2.0 / std::sqrt(max_eigenvalue(structure, linearisation.stiffness).value);
  const auto growth = [&](double h) {
    return test::spectral_radius(test::step_matrix(structure, std::ref(step), h, 0.5 * unit)) - 1.0;
  };
  EXPECT_LT(growth(2.38 * unit), 1e-3 * unit);
  constexpr double duration = 4000.0;
  EXPECT_GT(growth(1.19 * unit), 1.2 * tolerated(1.19 * unit, false, duration));
  // Smaller steps grow too, alike a second: it is the filter that does it, which is said.
  const CertifiedStep found =
      certified_step({structure, linearisation, structure.rest_position, Method::rk4, {}, &filter, duration});
  EXPECT_TRUE(found.always_grows);
  EXPECT_GT(found.step, 0.3 * unit);
}

// What the filter is at its weakest within the run, not at its start.
TEST(Certificate, CountsLambdaAtItsWeakestWithinTheDuration) {
  const Structure structure = crooked_sheet({0, 3});
  const Linearisation linearisation = linearise_at_rest(structure);
  const auto limit = [&](const FilterOptions& options, double duration) {
    const Filter filter(structure, options);
    return certified_step({structure, linearisation, structure.rest_position, Method::fb_euler, {}, &filter, duration})
        .step;
  };
  for (const FilterForm form : {FilterForm::conserving, FilterForm::symmetric}) {
    const FilterOptions strong{.lambda = 1.0, .form = form, .target = FilterTarget::force};
    FilterOptions weak = strong, keyed = strong;
    weak.lambda = 6.0;
    keyed.lambda_keys = {{0.0, 1.0}, {5.0, 1.0}, {6.0, 6.0}};
    EXPECT_NEAR(limit(keyed, 10.0), limit(weak, 10.0), 5e-3 * limit(weak, 10.0));
    EXPECT_NEAR(limit(keyed, 4.0), limit(strong, 10.0), 5e-3 * limit(strong, 10.0));
  }
}

TEST(Certificate, TakesAFilterOfCurrentDistancesForNone) {
  const Structure structure = crooked_sheet({0, 3});
  const Filter filter(
      structure,
      {.form = FilterForm::conserving, .target = FilterTarget::force, .distances = FilterDistances::current});
  EXPECT_EQ(certified_at_rest(structure, Method::fb_euler, &filter).step,
            certified_at_rest(structure, Method::fb_euler, nullptr).step);
}

TEST(Certificate, IsUnlimitedForTheImplicitSchemes) {
  const Structure structure = crooked_sheet({0, 3});
  const Filter filter(structure, {.form = FilterForm::symmetric});
  for (const Method method : {Method::backward_euler, Method::imex})
    for (const Filter* f : {static_cast<const Filter*>(nullptr), &filter})
      EXPECT_TRUE(certified_at_rest(structure, method, f).unlimited) << name(method);
}

TEST(Certificate, IsUnlimitedWithoutStiffness) {
  EXPECT_TRUE(certified_at_rest(grid({.width = 3, .height = 3, .structural = 0.0, .shear = 0.0, .bend = 0.0}),
                                Method::fb_euler, nullptr)
                  .unlimited);
}

TEST(Certificate, ScalesWithOneOverTheRootOfTheStiffness) {
  Structure soft = crooked_sheet({0, 3}), stiff = soft;
  stiff.stiffness *= 400.0;
  for (const Case& c : {Case{Method::fb_euler, std::nullopt}, Case{Method::fb_euler, FilterOptions{}},
                        Case{Method::rk4, FilterOptions{.form = FilterForm::symmetric}}}) {
    const auto limit = [&](const Structure& structure) {
      const std::optional<Filter> filter = c.filter ? std::make_optional<Filter>(structure, *c.filter) : std::nullopt;
      return certified_at_rest(structure, c.method, filter ? &*filter : nullptr).step;
    };
    EXPECT_NEAR(limit(soft) / limit(stiff), 20.0, 0.1);  // what is tolerated is so much a second
  }
}

TEST(Certificate, IsTheSameTwice) {
  const Structure structure = crooked_sheet({0, 3});
  const Filter filter(structure, {});
  EXPECT_EQ(certified_at_rest(structure, Method::fb_euler, &filter).step,
            certified_at_rest(structure, Method::fb_euler, &filter).step);
}

/// The sheet of docs/method.md: 10 x 10, side 1, two corners pinned, k0 = 1e6.
Structure reference_sheet() {
  Structure structure = grid({.width = 10, .height = 10, .spacing = 1.0 / 9.0, .pinned = {0, 9}});
  scale_stiffness(structure, 1e6);
  return structure;
}

// Ratios to the unfiltered limit of 2 ms, from dense eigenvalues computed independently of this program.
TEST(Certificate, ReproducesTheReferenceRatiosOfTheSheet) {
  const Structure structure = reference_sheet();
  const StiffnessMatrix stiffness = linearise_at_rest(structure).stiffness;
  EXPECT_NEAR(certified_at_rest(structure, Method::fb_euler, nullptr).step, 0.002, 0.005 * 0.002);
  for (const auto& [form, paper, exact] :
       {std::tuple{FilterForm::symmetric, 1.321, 1.172}, {FilterForm::plain, 1.881, 1.598}}) {
    const Filter filter(structure, {.form = form});
    const double alpha = filtered_eigenvalue(structure, stiffness, filter).value;
    EXPECT_NEAR(paper_step(Method::fb_euler, alpha).value() / 0.002, paper, 0.005 * paper);
    EXPECT_NEAR(certified_at_rest(structure, Method::fb_euler, &filter).step / 0.002, exact, 0.005 * exact);
  }
}

// Algorithm 1 is exact for a force filter and optimistic for a velocity filter.
TEST(PaperLimit, HoldsForForcesOnly) {
  const Structure structure = reference_sheet();
  const StiffnessMatrix stiffness = linearise_at_rest(structure).stiffness;
  for (const FilterForm form : {FilterForm::symmetric, FilterForm::conserving}) {
    const Filter force(structure, {.form = form, .target = FilterTarget::force}), velocity(structure, {.form = form});
    const double paper = paper_step(Method::fb_euler, filtered_eigenvalue(structure, stiffness, force).value).value();
    EXPECT_NEAR(certified_at_rest(structure, Method::fb_euler, &force).step, paper, 0.005 * paper);
    EXPECT_LT(certified_at_rest(structure, Method::fb_euler, &velocity).step, 0.95 * paper);
  }
}

/// Highest total energy over the first, in units of the energy that falling by one side releases.
double energy_gain(const Structure& structure, const Filter& filter, double h, double duration) {
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const auto energy = [&](const State& s) { return kinetic_energy(structure, s) + forces.potential_energy(s); };
  Step step(forces, Method::fb_euler, {}, &filter);
  State state = rest_state(structure);
  const double start = energy(state);
  double highest = start;
  for (int k = 0; k * h < duration; ++k) {
    step(state, h);
    highest = std::max(highest, energy(state));
    if (!(highest < 1e6)) break;
  }
  return (highest - start) / (9.81 * structure.mass.sum());
}

TEST(Certificate, ForAnyShapeHoldsForASheetThatFallsAndFolds) {
  const Structure structure = reference_sheet();
  const Linearisation any_shape = bound_of(structure, Shapes::any);
  for (const FilterTarget target : {FilterTarget::velocity, FilterTarget::force}) {
    const Filter filter(structure, {.form = FilterForm::symmetric, .target = target});
    const double limit = certified(structure, any_shape, Method::fb_euler, &filter).step;
    EXPECT_LT(energy_gain(structure, filter, 0.98 * limit, 4.0), 0.01) << static_cast<int>(target);
    EXPECT_GT(energy_gain(structure, filter, 2.0 * limit, 4.0), 1.0) << static_cast<int>(target);
  }
}

}  // namespace
}  // namespace billow::sim
