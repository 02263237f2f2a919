// Every scheme against its theory: amplification factors, orders, limits, what becomes of energy.
#include "sim/step/integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "sim/body/momenta.h"
#include "sim/step/step.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::fixed_chain;
using test::grid;
using test::oscillator;
using test::shaken_state;

using Complex = std::complex<double>;

constexpr Method all_methods[] = {Method::forward_euler, Method::fb_euler,       Method::verlet,
                                  Method::rk4,           Method::backward_euler, Method::imex};

// Linear systems solved to rounding, so that a scheme's own error is all there is.
constexpr IntegratorOptions exact_solver = {.linear_solver = LinearSolver::cholesky};

State run(const Forces& forces, Method method, State state, double h, int steps) {
  Step step(forces, method, exact_solver, nullptr);
  for (int k = 0; k < steps; ++k) step(state, h);
  return state;
}

double energy(const Structure& structure, const Forces& forces, const State& state) {
  return kinetic_energy(structure, state) + forces.potential_energy(state);
}

// x_k / x_0 of x'' = -omega^2 x from rest, z = omega h. The one-step schemes multiply x + i v / omega by a polynomial
// or its inverse; FB Euler and Verlet turn by theta with 2 sin(theta / 2) = z, FB Euler a half-step late.
double oscillation(Method method, double z, int k) {
  const Complex i(0.0, 1.0);
  const double theta = 2.0 * std::asin(0.5 * z);
  switch (method) {
    case Method::forward_euler:
      return std::pow(1.0 + i * z, k).real();
    case Method::fb_euler:
      return std::cos(k * theta) - std::tan(0.5 * theta) * std::sin(k * theta);
    case Method::verlet:
      return std::cos(k * theta);
    case Method::rk4:
      return std::pow(1.0 + i * z - z * z / 2.0 - i * z * z * z / 6.0 + z * z * z * z / 24.0, k).real();
    case Method::backward_euler:
    case Method::imex:
      return std::pow(1.0 / (1.0 - i * z), k).real();
  }
  return 0.0;
}

// Along the chain springs are linear, so its modes swing at omega_p = 2 sqrt(k/m) sin(p pi / (2 (n + 1))), each as the
// scheme's own oscillator.
TEST(EveryScheme, SwingsEachModeOfAChainAtItsFrequencyAndWithItsOwnError) {
  constexpr int n = 6;
  const Structure chain = fixed_chain({.free_particles = n, .mass = 0.2, .stiffness = 50.0});
  const Forces forces(chain, Eigen::Vector3d::Zero());
  for (const Method method : all_methods)
    for (int p = 1; p <= n; ++p)
      for (const double h : {0.001, 0.02}) {
        SCOPED_TRACE(testing::Message() << name(method) << ", mode " << p << ", h = " << h);
        const double omega = 2.0 * std::sqrt(50.0 / 0.2) * std::sin(p * std::numbers::pi / (2.0 * (n + 1)));
        Eigen::VectorXd mode(n + 2);
        for (int i = 0; i < n + 2; ++i) mode(i) = 1e-3 * std::sin(p * i * std::numbers::pi / (n + 1));
        State state = rest_state(chain);
        state.position.col(0) += mode;
        Step step(forces, method, exact_solver, nullptr);
        for (int k = 1; k <= 40; ++k) {
          step(state, h);
          const Eigen::VectorXd moved = state.position.col(0) - chain.rest_position.col(0);
          const double expected = oscillation(method, omega * h, k);
          ASSERT_LT((moved - expected * mode).norm(), 1e-8 * mode.norm() * std::max(1.0, std::abs(expected))) << k;
        }
      }
}

TEST(RungeKutta4, FindsThePeriodOfAnOscillator) {
  const Structure structure = oscillator(0.5, 80.0);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  State state = rest_state(structure);
  state.position(1, 0) += 0.01;
  const double period = 2.0 * std::numbers::pi * std::sqrt(0.5 / 80.0);
  state = run(forces, Method::rk4, state, period / 400.0, 4000);
  EXPECT_NEAR(state.position(1, 0), 1.01, 1e-9);
  EXPECT_NEAR(state.velocity(1, 0), 0.0, 1e-7);
}

// Least-squares slope of log(error) over log(step) for steps T / n.
double convergence_order(const std::vector<int>& steps, const std::function<double(int)>& error) {
  const int count = static_cast<int>(steps.size());
  Eigen::VectorXd x(count), y(count);
  for (int k = 0; k < count; ++k) x(k) = -std::log(steps[k]), y(k) = std::log(error(steps[k]));
  x.array() -= x.mean();
  return x.dot(y) / x.squaredNorm();
}

std::vector<int> step_counts(Method method) {
  return method == Method::rk4 ? std::vector{40, 80, 160} : std::vector{400, 800, 1600, 3200};
}

double theoretical_order(Method method) { return method == Method::rk4 ? 4.0 : method == Method::verlet ? 2.0 : 1.0; }

double distance(const State& a, const State& b, double omega) {
  return std::sqrt((a.position - b.position).squaredNorm() + (a.velocity - b.velocity).squaredNorm() / omega / omega);
}

// Not a whole period, where phase errors of first order would hide.
TEST(EveryScheme, ConvergesToTheExactOscillatorWithItsOrder) {
  const Structure structure = oscillator(0.5, 80.0);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  const double omega = std::sqrt(80.0 / 0.5), end = 2.2 / omega;
  State start = rest_state(structure), exact = start;
  start.position(1, 0) += 0.1;
  exact.position(1, 0) += 0.1 * std::cos(2.2);
  exact.velocity(1, 0) = -0.1 * omega * std::sin(2.2);
  for (const Method method : all_methods) {
    const double order = convergence_order(
        step_counts(method), [&](int n) { return distance(run(forces, method, start, end / n, n), exact, omega); });
    EXPECT_NEAR(order, theoretical_order(method), 0.05) << name(method);
  }
}

// A sheet that turns and folds under its weight, with damping where a scheme's order does not depend on it.
TEST(EveryScheme, ConvergesOnANonlinearSheetWithItsOrder) {
  Structure structure = grid({.width = 3, .height = 3, .spacing = 0.1, .mass = 0.01, .structural = 5.0, .pinned = {0}});
  const State start = shaken_state(structure, 0.02, 0.5, 5);
  const double end = 0.2, omega = std::sqrt(5.0 / 0.01);
  for (const Method method : all_methods) {
    structure.damping.setConstant(method == Method::verlet ? 0.0 : 0.01);
    const Forces forces(structure, {0.0, -9.81, 0.0});
    const State reference = run(forces, Method::rk4, start, end / 4000, 4000);
    const double order = convergence_order(
        step_counts(method), [&](int n) { return distance(run(forces, method, start, end / n, n), reference, omega); });
    EXPECT_NEAR(order, theoretical_order(method), 0.05) << name(method);
  }
}

// Largest displacement of a run from a disturbance of 1, in units of that disturbance.
double largest_swing(Method method, double omega_h, int steps) {
  const Structure structure = oscillator(0.5, 80.0);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  constexpr double disturbance = 1e-9;
  const double h = omega_h / std::sqrt(80.0 / 0.5);
  State state = rest_state(structure);
  state.position(1, 0) += disturbance;
  Step step(forces, method, {}, nullptr);
  double largest = 0.0;
  for (int k = 0; k < steps; ++k) {
    step(state, h);
    largest = std::max(largest, std::abs(state.position(1, 0) - 1.0) / disturbance);
    if (largest > 1e6) break;
  }
  return largest;
}

TEST(StepLimit, IsTwoForFBEulerAndVerletAndTwoRootTwoForRungeKutta) {
  for (const auto& [method, limit] :
       {std::pair{Method::fb_euler, 2.0}, {Method::verlet, 2.0}, {Method::rk4, 2.0 * std::numbers::sqrt2}}) {
    EXPECT_LT(largest_swing(method, 0.995 * limit, 3000), 11.0) << name(method) << ": 1 / sqrt(1 - 0.995^2) at most";
    EXPECT_GT(largest_swing(method, 1.005 * limit, 3000), 1e6) << name(method);
    EXPECT_EQ(scheme(method).omega_h, limit);
  }
}

TEST(StepLimit, DoesNotExistForForwardEulerWithoutDamping) {
  for (const double omega_h : {0.1, 0.5, 1.9}) {
    const int steps = static_cast<int>(40.0 / std::log1p(omega_h * omega_h));
    EXPECT_GT(largest_swing(Method::forward_euler, omega_h, steps), 1e6) << omega_h;
  }
}

TEST(StepLimit, DoesNotExistForTheImplicitSchemes) {
  for (const Method method : {Method::backward_euler, Method::imex}) {
    for (const double omega_h : {0.1, 3.0, 100.0}) EXPECT_LE(largest_swing(method, omega_h, 300), 1.0) << name(method);
    EXPECT_FALSE(scheme(method).omega_h.has_value());
    EXPECT_FALSE(is_explicit(method));
  }
}

TEST(StepLimit, OfAChainIsThatOfItsFastestMode) {
  constexpr int n = 10;
  const Structure chain = fixed_chain({.free_particles = n, .mass = 0.2, .stiffness = 50.0});
  const Forces forces(chain, Eigen::Vector3d::Zero());
  const double omega = 2.0 * std::sqrt(50.0 / 0.2) * std::sin(n * std::numbers::pi / (2.0 * (n + 1)));
  for (const auto& [factor, stable] : {std::pair{0.995, true}, {1.005, false}}) {
    State state = rest_state(chain);
    state.position.col(0) = shaken_state(chain, 1e-9, 0.0).position.col(0);
    Step step(forces, Method::fb_euler, {}, nullptr);
    for (int k = 0; k < 400; ++k) step(state, factor * 2.0 / omega);
    EXPECT_EQ((state.position - chain.rest_position).norm() < 1e-6, stable) << factor;
  }
}

// (1 + i z)(1 - i z) = 1 + omega^2 h^2: the gain and the loss of energy per step.
TEST(Energy, GrowsInForwardEulerAndDecaysInBackwardEulerAtTheTheoreticalRate) {
  const Structure structure = oscillator(0.5, 80.0);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  State start = rest_state(structure);
  start.position(1, 0) += 0.01;
  start.velocity(1, 0) = 0.2;
  for (const double omega_h : {0.01, 0.1, 0.5})
    for (const auto& [method, power] : {std::pair{Method::forward_euler, 20.0}, {Method::backward_euler, -20.0}}) {
      const State end = run(forces, method, start, omega_h / std::sqrt(80.0 / 0.5), 20);
      const double gain = energy(structure, forces, end) / energy(structure, forces, start);
      EXPECT_NEAR(gain, std::pow(1.0 + omega_h * omega_h, power), 1e-9 * gain) << name(method) << " " << omega_h;
    }
}

/// Lowest and highest total energy of a run over those of its start.
std::pair<double, double> energy_range(Method method, double h, int steps) {
  const Structure structure = grid({.width = 4, .height = 4, .spacing = 0.1, .mass = 0.01, .structural = 50.0});
  const Forces forces(structure, Eigen::Vector3d::Zero());
  State state = shaken_state(structure, 0.005, 0.1, 9);
  const double start = energy(structure, forces, state);
  std::pair range{1.0, 1.0};
  Step step(forces, method, exact_solver, nullptr);
  for (int k = 0; k < steps; ++k) {
    step(state, h);
    const double ratio = energy(structure, forces, state) / start;
    range = {std::min(range.first, ratio), std::max(range.second, ratio)};
  }
  return range;
}

TEST(Energy, StaysBoundedInTheSymplecticSchemesOverManySteps) {
  for (const Method method : {Method::fb_euler, Method::verlet}) {
    const auto [low, high] = energy_range(method, 0.002, 50000);
    EXPECT_GT(low, 0.7) << name(method);
    EXPECT_LT(high, 1.3) << name(method);
  }
}

TEST(Energy, ErrorOfTheSymplecticSchemesShrinksWithTheirOrder) {
  for (const auto& [method, ratio] : {std::pair{Method::fb_euler, 2.0}, {Method::verlet, 4.0}}) {
    const auto error = [&, m = method](double h, int steps) {
      const auto [low, high] = energy_range(m, h, steps);
      return high - low;
    };
    EXPECT_NEAR(error(0.0004, 1000) / error(0.0002, 2000), ratio, 0.1 * ratio) << name(method);
  }
}

TEST(Energy, NeverGrowsInBackwardEuler) {
  for (const double h : {0.001, 0.01, 0.1}) EXPECT_LE(energy_range(Method::backward_euler, h, 300).second, 1.0) << h;
}

TEST(Energy, GrowsInForwardEulerOnASheet) { EXPECT_GT(energy_range(Method::forward_euler, 0.002, 300).second, 2.0); }

double return_error(Method method) {
  const Structure structure = grid({.width = 4, .height = 4, .spacing = 0.1, .mass = 0.01, .structural = 50.0});
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const State start = shaken_state(structure, 0.01, 0.5, 9);
  State state = run(forces, method, start, 0.002, 500);
  state.velocity = -state.velocity;
  state = run(forces, method, state, 0.002, 500);
  return (state.position - start.position).norm() / start.position.norm();
}

TEST(Verlet, GoesBackTheWayItCame) {
  EXPECT_LT(return_error(Method::verlet), 1e-8);
  EXPECT_GT(return_error(Method::fb_euler), 1e-4) << "the test must be able to tell";
}

TEST(EveryScheme, NeverMovesAPinnedParticle) {
  Structure structure =
      grid({.width = 4, .height = 4, .spacing = 0.1, .mass = 0.01, .structural = 5.0, .pinned = {0, 6}});
  structure.damping.setConstant(0.01);
  structure.body[0].friction = 0.001;
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const State start = shaken_state(structure, 0.01, 0.5);
  for (const Method method : all_methods)
    for (const LinearSolver solver : {LinearSolver::conjugate_gradient, LinearSolver::cholesky})
      for (const bool filtered : {false, true}) {
        const Filter filter(structure, {});
        Step step(forces, method, {.linear_solver = solver}, filtered ? &filter : nullptr);
        State state = start;
        for (int k = 0; k < 200; ++k) step(state, 0.001);
        EXPECT_GT((state.position - start.position).norm(), 0.01) << name(method) << " must move the rest";
        for (const int pin : {0, 6}) {
          EXPECT_EQ(state.position.row(pin), start.position.row(pin)) << name(method);
          EXPECT_TRUE(state.velocity.row(pin).isZero(0.0)) << name(method);
        }
      }
}

TEST(EveryScheme, FallsFreelyWithGravity) {
  const Structure structure = grid({.width = 3, .height = 3});
  const Forces forces(structure, {0.0, -9.81, 0.0});
  for (const Method method : all_methods) {
    const State end = run(forces, method, rest_state(structure), 1e-3, 1000);
    EXPECT_NEAR(end.time, 1.0, 1e-12);
    EXPECT_NEAR(end.velocity.col(1).mean(), -9.81, 1e-9) << name(method);
    EXPECT_NEAR(end.position.col(1).mean(), -0.5 * 9.81, 0.5 * 9.81 * 1.1e-3) << name(method);
  }
}

/// Lets nothing through.
class Stop : public StepHook {
 public:
  void apply(const State&, const Move&, Eigen::MatrixX3d& velocity) override { velocity.setZero(); }
};

TEST(EveryScheme, MovesByTheVelocitiesThatAHookLeaves) {
  const Structure structure = grid({.width = 3, .height = 3, .pinned = {0}});
  const Forces forces(structure, {0.0, -9.81, 0.0});
  for (const Method method : all_methods) {
    State state = rest_state(structure);
    Step step(forces, method, exact_solver, nullptr);
    step.add(std::make_unique<Stop>());
    step(state, 0.01);
    EXPECT_TRUE(state.velocity.isZero(0.0)) << name(method);
    if (method == Method::rk4) continue;  // knows position and velocity at once
    EXPECT_EQ(state.position, structure.rest_position) << name(method);
  }
}

}  // namespace
}  // namespace billow::sim
