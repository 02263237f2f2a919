// What hangs still: chains and catenaries have closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/step/step.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::fixed_chain;

State settled(const Structure& structure, const Eigen::Vector3d& gravity, Method method, State state, double h,
              int steps) {
  const Forces forces(structure, gravity);
  Step step(forces, method, {.linear_solver = LinearSolver::cholesky}, nullptr);
  for (int k = 0; k < steps; ++k) step(state, h);
  return state;
}

// n masses on springs below a wall: L = n L0 + (m g / k) n (n + 1) / 2, each spring carrying all that hangs on it.
TEST(HangingChain, HasTheLengthOfItsClosedForm) {
  constexpr int n = 10;
  Structure chain =
      fixed_chain({.free_particles = n, .mass = 0.1, .stiffness = 500.0, .rest_length = 0.1, .second_wall = false});
  chain.body[0].friction = 1.0;
  for (const Method method :
       {Method::forward_euler, Method::fb_euler, Method::verlet, Method::rk4, Method::backward_euler, Method::imex}) {
    const double h = method == Method::forward_euler ? 0.0004 : 0.002;  // its limit is friction / stiffness of 0.0005 s
    const State end = settled(chain, {9.81, 0.0, 0.0}, method, rest_state(chain), h, static_cast<int>(30.0 / h));
    EXPECT_NEAR(end.position(n, 0), 1.107910, 1e-5) << name(method);
    EXPECT_NEAR(end.position(n, 0), n * 0.1 + 0.1 * 9.81 / 500.0 * n * (n + 1) / 2.0, 1e-9) << name(method);
  }
}

// A filter acts on velocities or accelerations, and none are left at rest: the shape must not depend on it.
TEST(HangingChain, HangsTheSameWithAFilter) {
  constexpr int n = 10;
  Structure chain =
      fixed_chain({.free_particles = n, .mass = 0.1, .stiffness = 500.0, .rest_length = 0.1, .second_wall = false});
  chain.body[0].friction = 1.0;
  const Forces forces(chain, {9.81, 0.0, 0.0});
  for (const FilterTarget target : {FilterTarget::velocity, FilterTarget::force})
    for (const FilterForm form : {FilterForm::plain, FilterForm::symmetric, FilterForm::conserving}) {
      const Filter filter(chain, {.form = form, .target = target});
      Step step(forces, Method::fb_euler, {}, &filter);
      State state = rest_state(chain);
      for (int k = 0; k < 15000; ++k) step(state, 0.002);
      EXPECT_NEAR(state.position(n, 0), 1.107910, 1e-5)
          << "form " << static_cast<int>(form) << ", target " << static_cast<int>(target);
    }
}

// An inextensible cable of length 1.5 between two points 1 apart sags by 0.502633.
double cable_sag(int segments) {
  const double length = 1.5 / segments, stiffness = 1e6 / length;
  Structure cable = fixed_chain(
      {.free_particles = segments - 1, .mass = 1.0 / segments, .stiffness = stiffness, .rest_length = length});
  cable.body[0].friction = 2.0 / segments;
  State start = rest_state(cable);
  for (int i = 0; i <= segments; ++i) {
    const double x = static_cast<double>(i) / segments;
    start.position.row(i) << x, -2.0 * x * (1.0 - x), 0.0;
  }
  const State end = settled(cable, {0.0, -9.81, 0.0}, Method::backward_euler, start, 0.02, 1500);
  EXPECT_LT(end.velocity.norm(), 1e-6);
  return -end.position.col(1).minCoeff();
}

TEST(Catenary, SagsAsTheInextensibleCableDoesToSecondOrder) {
  const double coarse = cable_sag(10) - 0.502633, fine = cable_sag(20) - 0.502633, finest = cable_sag(40) - 0.502633;
  EXPECT_LT(std::abs(finest), 5e-4);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
  EXPECT_NEAR(fine / finest, 4.0, 0.4);
}

}  // namespace
}  // namespace billow::sim
