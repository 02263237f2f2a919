// What contact costs: time per step of the shipped scenes with contact and with what touches taken out, over a window
// of time in which it has most to do, and how that grows with the number of vertices.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/report.h"
#include "cli/scene/scene.h"
#include "cli/scene/simulation.h"

namespace billow {
namespace {

struct Case {
  std::string label, scene;
  int side = 0;                   // vertices of a grid that takes the cloth's place; 0: the scene's own mesh
  double begin = 0.0, end = 0.0;  // [s] simulated: the window
  int bodies = 1;
  double target = 0.0;  // with contact over without
};

struct Times {
  double clock = 0.0, processor = 0.0;  // [s] a step
  double step = 0.0;                    // [s]
  int particles = 0;
};

struct Measurement {
  Case which;
  Times with, without;
};

std::vector<Case> cases() {
  std::vector<Case> list;
  for (const int side : {50, 71, 100, 141, 200})
    list.push_back({.label = fmt::format("sphere, {}²", side),
                    .scene = "sphere",
                    .side = side,
                    .begin = 0.3,
                    .end = side > 120 ? 0.32 : 0.4,
                    .target = 3.0});
  list.push_back({.label = "stack", .scene = "stack", .begin = 0.6, .end = 0.8, .bodies = 5, .target = 6.0});
  return list;
}

// 1 m x 1 m, level, from z = 0 to 1, as the cloths of assets/.
void write_grid(const std::filesystem::path& file, int side) {
  std::ofstream out(file);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      out << fmt::format("v {} 0 {}\n", column / (side - 1.0) - 0.5, row / (side - 1.0));
  for (int row = 0; row + 1 < side; ++row)
    for (int column = 0; column + 1 < side; ++column) {
      const int k = row * side + column + 1;
      out << fmt::format("f {} {} {} {}\n", k, k + side, k + side + 1, k + 1);
    }
}

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Times time_of(const Case& which, bool touching, const std::string& mesh) {
  std::vector<cli::Override> overrides;
  if (!mesh.empty()) overrides.push_back({"bodies.0.cloth.mesh", mesh});
  for (int b = 0; b < which.bodies && !touching; ++b)
    overrides.push_back({fmt::format("bodies.{}.contact", b), "none"});
  const cli::Scene scene = cli::read_scene(fmt::format("{}/scenes/{}.yaml", BILLOW_SOURCE_DIR, which.scene), overrides);
  const cli::Simulation simulation(scene);
  const auto solver = simulation.make_solver(simulation.choose_step());
  while (solver->state().time < which.begin) solver->advance();
  const long steps = solver->steps();
  const double clock = clock_seconds(), processor = bench::processor_seconds();
  while (solver->state().time < which.end) solver->advance();
  const auto taken = static_cast<double>(solver->steps() - steps);
  return {(clock_seconds() - clock) / taken, (bench::processor_seconds() - processor) / taken, solver->step(),
          simulation.structure().particles()};
}

Measurement measure(const Case& which, const std::filesystem::path& folder) {
  std::string mesh;
  if (which.side > 0) {
    const auto file = folder / fmt::format("grid_{}.obj", which.side);
    write_grid(file, which.side);
    mesh = file.string();
  }
  return {which, time_of(which, true, mesh), time_of(which, false, mesh)};
}

// Time of a step over n log n, against the smallest of the same scene.
double growth(const std::vector<Measurement>& all, const Measurement& m) {
  const auto scale = [](const Measurement& of) { return of.with.particles * std::log(of.with.particles); };
  for (const Measurement& first : all)
    if (first.which.scene == m.which.scene) return m.with.processor / scale(m) / (first.with.processor / scale(first));
  return 1.0;
}

void print_table(const std::vector<Measurement>& all) {
  fmt::print("{:<14} {:>9} {:>9} {:>10} {:>10} {:>7} {:>7} {:>8}\n", "ms a step", "vertices", "step, ms", "with",
             "without", "ratio", "target", "growth");
  for (const Measurement& m : all)
    fmt::print("{:<14} {:>9} {:>9.3f} {:>10.3f} {:>10.3f} {:>7.1f} {:>7.0f} {:>8.2f}\n", m.which.label,
               m.with.particles, 1e3 * m.with.step, 1e3 * m.with.clock, 1e3 * m.without.clock,
               m.with.clock / m.without.clock, m.which.target, growth(all, m));
  fmt::print(
      "\nwith and without contact, by the clock on all threads; growth: processor time of a step over n log n, "
      "against\n"
      "the same scene's smallest\n");
}

void print_json(const std::vector<Measurement>& all) {
  nlohmann::ordered_json json = nlohmann::json::array();
  for (const Measurement& m : all)
    json.push_back({{"case", m.which.label},
                    {"vertices", m.with.particles},
                    {"step", m.with.step},
                    {"seconds_per_step", m.with.clock},
                    {"seconds_per_step_without_contact", m.without.clock},
                    {"processor_seconds_per_step", m.with.processor},
                    {"growth_over_n_log_n", growth(all, m)}});
  fmt::print("{}\n", json.dump(1));
}

int run(bool as_json) {
  std::string pattern = (std::filesystem::temp_directory_path() / "billow-bench-XXXXXX").string();
  if (!mkdtemp(pattern.data())) {
    fmt::print(stderr, "no folder for meshes at {}\n", pattern);
    return 1;
  }
  std::vector<Measurement> all;
  for (const Case& which : cases()) all.push_back(measure(which, pattern));
  std::filesystem::remove_all(pattern);
  as_json ? print_json(all) : print_table(all);
  return 0;
}

}  // namespace
}  // namespace billow

int main(int argc, char** argv) { return billow::bench::report_main(argc, argv, billow::run); }
