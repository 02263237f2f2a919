// Nothing passes through anything: every frame of every scene of touching_scenes.h, by exact predicates, and with the
// same bits however many threads there are.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "sim/body/momenta.h"
#include "tests/support/touching_scenes.h"

namespace billow::test {
namespace {

constexpr double frame = 0.02;  // [s]

/// What a run with so many threads comes to.
struct Outcome {
  std::size_t crossings = 0;
  sim::State last;
};

Outcome run(const TouchingScene& scene, int threads, bool checked) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  TouchingRun run(scene);
  Outcome outcome;
  for (double time = frame; time <= scene.duration + 1e-9; time += frame) {
    outcome.last = run.sample(time);
    if (checked) outcome.crossings += run.crossings_at(outcome.last);
  }
  return outcome;
}

class NothingCrosses : public testing::TestWithParam<std::string> {};

TEST_P(NothingCrosses, InAnyFrameAndWithTheSameBitsOnOneThreadAndTwo) {
  const auto scene = touching_scene_named(GetParam());
  const Outcome two = run(*scene, 2, true), one = run(*scene, 1, false);
  EXPECT_EQ(two.crossings, 0u);
  EXPECT_TRUE(two.last.position == one.last.position && two.last.velocity == one.last.velocity);
  EXPECT_TRUE(two.last.position.allFinite());
}

INSTANTIATE_TEST_SUITE_P(Scenes, NothingCrosses, testing::ValuesIn(touching_scene_names()),
                         [](const auto& name) { return name.param; });

// What the scenes are checked with sees what they would come to without contact.
TEST(NothingCrossesChecker, FindsCrossingsWhereNothingTouches) {
  const auto scene = touching_scene_named("stack");
  for (sim::BodyContact& body : scene->contact.body) body.thickness = 1e-6, body.self = false;
  TouchingRun watched(*scene);
  const sim::Forces forces(scene->structure, scene->gravity);
  sim::Solver free(scene->structure, forces, {.step = scene->step, .max_strain = sim::torn_strain}, scene->start);
  sim::State state = free.sample(0.3);
  // Bodies in free fall stay apart: let each fall farther than the one below it.
  for (std::size_t b = 0; b < scene->structure.body.size(); ++b) {
    const sim::Body& body = scene->structure.body[b];
    for (int i = body.first_particle; i < body.first_particle + body.particles; ++i)
      state.position(i, 1) += 0.04 * std::sin(20.0 * state.position(i, 0) + static_cast<double>(b));
  }
  EXPECT_GT(watched.crossings_at(state), 10u);
}

}  // namespace
}  // namespace billow::test
