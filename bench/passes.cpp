// Force pass, filter pass, whole filtered FB Euler step, and an iteration of the implicit schemes' linear solve.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <map>
#include <memory>

#include "base/huge_pages.h"
#include "base/random.h"
#include "bench/cloths.h"
#include "bench/sections.h"
#include "sim/filter/filter.h"
#include "sim/force/forces.h"
#include "sim/force/spring_force.h"
#include "sim/linear/block_jacobi.h"
#include "sim/linear/conjugate_gradient.h"
#include "sim/step/step.h"

namespace billow::bench {

namespace {

constexpr double step_size = 1e-6;  // [s] so small that the cloth stays as it is however many steps are taken

// A cloth a little out of rest, so that no branch is better predicted than in a run.
sim::State stretched(const sim::Structure& structure) {
  sim::State state = sim::rest_state(structure);
  state.position.col(0) *= 1.02;
  use_huge_pages(state.position), use_huge_pages(state.velocity);  // as a run's are
  return state;
}

// Runs `work` over and over with `threads` threads.
template <class Work>
void measure(benchmark::State& run, const sim::Structure& structure, int threads, const Work& work) {
  oneapi::tbb::task_arena arena(threads);
  arena.execute([&] {
    work();  // what a run does once is not timed: pages are found, arrays of their own made
    for (auto _ : run) work();
  });
  run.counters["springs"] = structure.springs();
}

/// Everything about a cloth that a run makes once.
struct Prepared {
  explicit Prepared(const sim::Structure& cloth)
      : structure(cloth), springs(cloth), forces(cloth, {0.0, -9.81, 0.0}), filter(cloth, {}) {}

  const sim::Structure& structure;
  sim::SpringForce springs;
  sim::Forces forces;
  sim::Filter filter;
};

const sim::FilterOptions levels_options{
    .kernel = sim::FilterKernel::levels, .target = sim::FilterTarget::force, .ratio = 6.0};

// Shares are sought once for every cloth, which takes longer than a benchmark of it.
const sim::Filter& levels_of(const std::string& name) {
  static std::map<std::string, std::unique_ptr<const sim::Filter>> made;
  std::unique_ptr<const sim::Filter>& entry = made[name];
  if (!entry) entry = std::make_unique<const sim::Filter>(cloth(name), levels_options);
  return *entry;
}

const Prepared& prepared(const std::string& name) {
  static std::map<std::string, std::unique_ptr<const Prepared>> made;
  std::unique_ptr<const Prepared>& entry = made[name];
  if (!entry) entry = std::make_unique<const Prepared>(cloth(name));
  return *entry;
}

void force_pass(benchmark::State& run, const std::string& name, int threads) {
  const Prepared& on = prepared(name);
  const sim::State state = stretched(on.structure);
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(on.structure.particles(), 3);
  use_huge_pages(force);
  sim::ForceScratch scratch;
  sim::SpringSink sink;
  for (int axis = 0; axis < 3; ++axis) sink.out[axis] = force.col(axis).data();
  measure(run, on.structure, threads, [&] { on.springs.sweep(state, sink, false, scratch); });
}

void filter_pass(benchmark::State& run, const std::string& name, int threads) {
  const Prepared& on = prepared(name);
  sim::State state = stretched(on.structure);
  sim::FilterScratch scratch;
  measure(run, on.structure, threads, [&] { on.filter.apply(state.position, 0.0, state.velocity, scratch); });
}

void levels_pass(benchmark::State& run, const std::string& name, int threads) {
  const Prepared& on = prepared(name);
  const sim::Filter& levels = levels_of(name);
  sim::State state = stretched(on.structure);
  sim::FilterScratch scratch;
  measure(run, on.structure, threads, [&] { levels.apply(state.position, 0.0, state.velocity, scratch); });
}

void filtered_step(benchmark::State& run, const std::string& name, int threads) {
  const Prepared& on = prepared(name);
  sim::Step step(on.forces, sim::Method::fb_euler, {}, &on.filter);
  sim::State state = stretched(on.structure);
  measure(run, on.structure, threads, [&] { step(state, step_size); });
}

constexpr int cg_iterations = 20;
constexpr double out_of_reach = 1e-60;  // a relative residual, so that all of them are made

// Iterations of backward Euler's linear solve at 0.01 s, with its preconditioner.
void cg_iteration(benchmark::State& run, const std::string& name, int threads) {
  constexpr double h = 0.01;  // [s]
  const Prepared& on = prepared(name);
  const int n = on.structure.particles();
  const sim::State state = stretched(on.structure);
  sim::StiffnessMatrix system = on.forces.linearise(state, h * h, h, sim::JacobianForm::definite);
  for (int i = 0; i < n; ++i) system.add_diagonal(i, on.structure.mass(i));
  sim::BlockJacobi blocks;
  blocks.set(system);
  const sim::LinearSystem linear{[&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) { system.multiply(x, y); },
                                 [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) { blocks.apply(x, y); }};
  const Eigen::MatrixX3d right = seeded_noise(n, 1);
  Eigen::MatrixX3d x(n, 3);
  sim::ConjugateGradient gradient;
  measure(run, on.structure, threads, [&] {
    x.setZero();
    gradient.start(linear, right, x);
    gradient.solve(out_of_reach, cg_iterations);
  });
  run.counters["springs"] = static_cast<double>(on.structure.springs()) * cg_iterations;
}

void add(const std::string& pass, const std::string& name, int threads,
         void (*function)(benchmark::State&, const std::string&, int)) {
  benchmark::RegisterBenchmark(pass_name(pass, name, threads).c_str(), function, name, threads)->UseRealTime();
}

}  // namespace

std::string pass_name(const std::string& pass, const std::string& cloth, int threads) {
  return fmt::format("{}, {}, {} thread{}", pass, cloth, threads, threads == 1 ? "" : "s");
}

Targets add_passes() {
  Targets targets;
  const auto force = [](const std::string& name, int threads = 1) { return pass_name("force", name, threads); };
  for (const std::string name : {"grid 32", "grid 100", "grid 300", "grid 1000", "irregular 0", "irregular 1"})
    for (const int threads : {1, 2}) {
      add("force", name, threads, force_pass);
      add("filter", name, threads, filter_pass);
      add("step", name, threads, filtered_step);
      add("CG", name, threads, cg_iteration);
      if (name != "grid 1000") add("levels", name, threads, levels_pass);
      const bool large = name == "grid 300" || name == "grid 1000";
      if (threads == 2)
        targets.push_back({fmt::format("step on {}: 2 threads against 1", name), pass_name("step", name, 1),
                           pass_name("step", name, 2), large ? 1.7 : 0.95, true, true});
    }
  targets.push_back({"force pass, grid 100, against the ceiling", force("grid 100"), ceiling_name, 1.5});
  for (const std::string name : {"irregular 0", "irregular 1"})
    targets.push_back({fmt::format("force pass, {}, against the ceiling", name), force(name), ceiling_name, 2.5});
  targets.push_back(
      {"filter pass against force pass, grid 100", pass_name("filter", "grid 100", 1), force("grid 100"), 0.4});
  for (const auto& [name, limit] :
       {std::pair("grid 100", 0.7), {"grid 300", 0.7}, {"irregular 0", 0.9}, {"irregular 1", 0.9}})
    targets.push_back(
        {fmt::format("levels against force pass, {}", name), pass_name("levels", name, 1), force(name), limit});
  targets.push_back(
      {"whole step against force pass, grid 100", pass_name("step", "grid 100", 1), force("grid 100"), 1.7});
  targets.push_back({"force pass, grid 1000 against grid 100", force("grid 1000"), force("grid 100"), 3.0});
  return targets;
}

}  // namespace billow::bench
