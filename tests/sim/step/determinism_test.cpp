// Short runs against a hash of where they end, so that a change of their bits is noticed on whichever machine it shows:
// by instruction set, by number of threads, by compiler, by the optimiser.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <random>

#include "base/random.h"
#include "sim/body/fish.h"
#include "sim/force/muscle_force.h"
#include "sim/force/water_force.h"
#include "sim/step/step.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/structures.h"
#include "tests/support/swimmers.h"

namespace billow::sim {
namespace {

// The runs keep to what IEEE 754 fixes: sums, products, quotients and roots. exp, sin and cos are the C library's,
// whose last digit depends on whether the processor has fused multiply-adds (glibc 2.36: one argument in 1600 differs).
// So filters get the distances 1, sqrt 2 and 2 alone, at which every library rounds e^-d alike; the fish turns without
// swimming, which takes no sine; and Choi and Ko's beams, whose angle takes both, are left out.

std::uint64_t fnv_1a(const Eigen::MatrixX3d& field, std::uint64_t hash) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(field.data());
  for (std::size_t k = 0; k < sizeof(double) * static_cast<std::size_t>(field.size()); ++k)
    hash = (hash ^ bytes[k]) * 0x100000001b3;
  return hash;
}

std::uint64_t hash_of(const State& state) { return fnv_1a(state.velocity, fnv_1a(state.position, 0xcbf29ce484222325)); }

/// A sheet whose coordinates and rest lengths are exact, so that no distance depends on how it is rounded.
Structure sheet(int width, std::vector<int> pinned) {
  Structure structure = test::grid({.width = width,
                                    .height = width,
                                    .spacing = 0.125,
                                    .mass = 0.01,
                                    .structural = 100.0,
                                    .shear = 70.0,
                                    .bend = 30.0,
                                    .pinned = std::move(pinned)});
  structure.damping.setConstant(0.01);
  structure.body[0].friction = 0.001;
  return structure;
}

/// Numbered at random, of uneven masses and stiffness: what the passes take as irregular.
Structure irregular(Structure structure) {
  std::vector<int> number(structure.particles());
  std::iota(number.begin(), number.end(), 0);
  std::mt19937 bits(3);
  for (std::size_t k = number.size(); k > 1; --k) std::swap(number[k - 1], number[bits() % k]);
  structure.rest_position(number, Eigen::all) = structure.rest_position.eval();
  for (int s = 0; s < structure.springs(); ++s) {
    const auto [low, high] = std::minmax(number[structure.spring(s, 0)], number[structure.spring(s, 1)]);
    structure.spring.row(s) << low, high;
  }
  structure.stiffness.array() *= 1.0 + 0.5 * seeded_noise(structure.springs(), 11).col(0).array();
  return test::with_uneven_masses(structure, 0.5);
}

State run(const Structure& structure, const Forces& forces, Method method, const IntegratorOptions& options,
          const Filter* filter, double h, int steps) {
  State state = test::shaken_state(structure, 0.01, 0.5);
  Step step(forces, method, options, filter);
  for (int k = 0; k < steps; ++k) step(state, h);
  return state;
}

State run_of_a_sheet(const Structure& structure, Method method, const IntegratorOptions& options,
                     const std::optional<FilterOptions>& filter) {
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const std::optional<Filter> f = filter ? std::make_optional<Filter>(structure, *filter) : std::nullopt;
  return run(structure, forces, method, options, f ? &*f : nullptr, 0.004, 25);
}

State run_of_a_fish() {
  MotionOptions motion;
  motion.keys = {{0.0, 0.0, 0.5, 1.0}, {1.0, 0.0, -0.7, 1.0}};
  const test::Swimmer fish(motion);
  return run(fish.structure, *fish.forces, Method::fb_euler, {}, nullptr, 0.02, 100);
}

// Eigen's own products are fused where an architecture always has the instruction, as ARM64 does, and end elsewhere.
#ifdef __x86_64__
constexpr bool known_architecture = true;
#else
constexpr bool known_architecture = false;
#endif

/// On every instruction set, by one thread and by several.
void expect_hash(const std::function<State()>& work, std::uint64_t expected) {
  if (!known_architecture) expected = hash_of(work());
  const oneapi::tbb::global_control more_than_cores(oneapi::tbb::global_control::max_allowed_parallelism, 4);
  test::on_every_instruction_set([&] {
    for (const int threads : {1, 4}) {
      State end;
      oneapi::tbb::task_arena(threads).execute([&] { end = work(); });
      ASSERT_TRUE(end.position.allFinite());
      EXPECT_EQ(hash_of(end), expected) << threads << " threads, hash " << std::hex << "0x" << hash_of(end);
    }
  });
}

constexpr int wide = 92;  // squared, enough particles for several threads

TEST(HashOfTheEnd, OfAFilteredRegularSheet) {
  const Structure structure = sheet(wide, {0, wide - 1});
  expect_hash([&] { return run_of_a_sheet(structure, Method::fb_euler, {}, FilterOptions{}); }, 0xa208b72d58940d91);
}

TEST(HashOfTheEnd, OfAFilteredIrregularSheet) {
  const Structure structure = irregular(sheet(wide, {0, wide - 1}));
  const FilterOptions filter{.form = FilterForm::symmetric, .passes = 2};
  expect_hash([&] { return run_of_a_sheet(structure, Method::fb_euler, {}, filter); }, 0xe14e82bcde7a1161);
}

TEST(HashOfTheEnd, OfAFreeIrregularSheetWhoseFilterRestoresItsMomenta) {
  const Structure structure = irregular(sheet(20, {}));
  const FilterOptions filter{.form = FilterForm::conserving, .target = FilterTarget::force};
  expect_hash([&] { return run_of_a_sheet(structure, Method::verlet, {}, filter); }, 0x2c327b6bf6f13cfb);
}

TEST(HashOfTheEnd, OfRungeKutta4) {
  const Structure structure = irregular(sheet(20, {0, 19}));
  expect_hash([&] { return run_of_a_sheet(structure, Method::rk4, {}, std::nullopt); }, 0x76e0f467e9a7a618);
}

TEST(HashOfTheEnd, OfBackwardEulerByConjugateGradients) {
  const Structure structure = irregular(sheet(20, {0, 19}));
  expect_hash([&] { return run_of_a_sheet(structure, Method::backward_euler, {}, std::nullopt); }, 0x1ced0e3333b42dc3);
}

TEST(HashOfTheEnd, OfBackwardEulerByCholesky) {
  const Structure structure = irregular(sheet(12, {0, 11}));
  const IntegratorOptions direct{.linear_solver = LinearSolver::cholesky};
  expect_hash([&] { return run_of_a_sheet(structure, Method::backward_euler, direct, std::nullopt); },
              0x1c96cdd04f71d8d4);
}

TEST(HashOfTheEnd, OfImex) {
  const Structure structure = irregular(sheet(20, {0, 19}));
  expect_hash([&] { return run_of_a_sheet(structure, Method::imex, {}, std::nullopt); }, 0x757d51d731ad5278);
}

TEST(HashOfTheEnd, OfAFishThatTurnsInWater) {
  expect_hash([] { return run_of_a_fish(); }, 0xcfb1d59aaed26a71);
}

}  // namespace
}  // namespace billow::sim
