// What filtering buys: seconds of computing per simulated second for the drape, and how much of its swing is left, for
// every way of taking longer steps. The scene is the one that ships, read, certified and stepped as `billow render`
// does.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "bench/report.h"
#include "cli/scene/scene.h"
#include "cli/scene/simulation.h"
#include "sim/body/momenta.h"
#include "sim/limit/measured_limit.h"

namespace billow {
namespace {

constexpr double simulated = 4.0;      // [s] some three swings
constexpr double sample_step = 0.005;  // [s] between looks at the centre of mass
constexpr double timed = 2.0;          // [s] simulated for the clock, without looks
constexpr int repetitions = 3;         // of which the fastest counts: what else the machine does only slows down

struct Case {
  std::string label;
  std::vector<cli::Override> overrides;
};

/// What is left of the drape's motion.
struct Motion {
  double swing = 0.0;  // the third turn's distance from the vertical over the first's
  double lost = 0.0;   // energy, as a share of the weight times the size
};

struct Measurement {
  std::string label;
  double step = 0.0;             // [s]
  double cost = 0.0;             // [s] of computing per simulated second
  double iterations = 0.0;       // of the conjugate gradient per step
  std::optional<Motion> motion;  // none when it diverged
};

// The first entry is what swings are compared with, the second what costs are.
std::vector<Case> cases() {
  std::vector<Case> list{
      {"RK4, a fifth of its limit", {{"solver.method", "rk4"}, {"solver.filter", "none"}, {"solver.safety", "0.2"}}},
      {"FB Euler", {{"solver.filter", "none"}}}};
  for (const char* target : {"force", "velocity"})
    for (const char* form : {"conserving", "symmetric"})
      for (const int passes : {1, 2})
        list.push_back(
            {fmt::format("FB Euler, {} filter, {} x{}", target, form, passes),
             {{"solver.filter", fmt::format("{{kernel: exponential, lambda: 1, form: {}, target: {}, passes: {}}}",
                                            form, target, passes)}}});
  for (const int ratio : {3, 6, 10})
    list.push_back({fmt::format("FB Euler, levels x{}", ratio),
                    {{"solver.filter", fmt::format("{{kernel: levels, ratio: {}}}", ratio)}}});
  for (const char* method : {"backward_euler", "imex"})
    list.push_back({fmt::format("{} at 0.01 s", method == std::string("imex") ? "IMEX" : "backward Euler"),
                    {{"solver.filter", "none"}, {"solver.method", method}, {"solver.step", "0.01"}}});
  return list;
}

// Without the scene's air, so that only the scheme and the filter take energy out.
cli::Scene scene_of(const std::string& file, const Case& which) {
  std::vector<cli::Override> overrides = which.overrides;
  overrides.push_back({"bodies.0.cloth.damping.friction", "0"});
  return cli::read_scene(file, overrides);
}

// How far the centre of mass is from the vertical plane through the pins, in the direction in which it started.
class Swing {
 public:
  explicit Swing(const sim::Structure& structure) : structure_(structure) {
    int pins = 0;
    for (int i = 0; i < structure.particles(); ++i)
      if (structure.pinned(i)) pivot_ += structure.rest_position.row(i).transpose(), ++pins;
    pivot_ /= std::max(1, pins);
    outward_ = centre(structure.rest_position) - pivot_;
    outward_.y() = 0.0;
    outward_.normalize();
  }
  double operator()(const sim::State& state) const { return (centre(state.position) - pivot_).dot(outward_); }

 private:
  Eigen::Vector3d centre(const Eigen::MatrixX3d& position) const {
    return position.transpose() * structure_.mass / structure_.mass.sum();
  }
  const sim::Structure& structure_;
  Eigen::Vector3d pivot_ = Eigen::Vector3d::Zero(), outward_;
};

// Distances from the vertical at the turning points after the release, one for each half swing.
std::vector<double> turns(const std::vector<double>& offset) {
  std::vector<double> peak;
  double extreme = 0.0;
  for (std::size_t k = 1; k < offset.size(); ++k) {
    const bool crossed = (offset[k] < 0.0) != (offset[k - 1] < 0.0);
    if (crossed && k > 1) peak.push_back(extreme), extreme = 0.0;
    extreme = std::max(extreme, std::abs(offset[k]));
  }
  return peak;  // the last half swing is not whole
}

double energy(const cli::Simulation& simulation, const sim::State& state) {
  return sim::kinetic_energy(simulation.structure(), state) + simulation.forces().potential_energy(state);
}

std::optional<Motion> watch(const cli::Scene& scene, const cli::Simulation& simulation, const cli::StepChoice& choice) {
  const Swing swing(simulation.structure());
  const auto solver = simulation.make_solver(choice);
  const double begin = energy(simulation, solver->state());
  const double scale =
      sim::energy_scale(simulation.structure(), simulation.forces(), scene.gravity, simulation.initial_state());
  std::vector<double> offset;
  try {
    for (int k = 0; k * sample_step < simulated; ++k) offset.push_back(swing(solver->sample(k * sample_step)));
  } catch (const DivergenceError&) {
    return std::nullopt;
  }
  const std::vector<double> turn = turns(offset);  // the release is the first
  return Motion{turn.size() < 4 ? 0.0 : turn[3] / turn[1], (begin - energy(simulation, solver->state())) / scale};
}

// Also counts the iterations of a step.
double cost_of(const cli::Simulation& simulation, const cli::StepChoice& choice, double& iterations) {
  double least = INFINITY;
  for (int r = 0; r < repetitions; ++r) {
    const auto solver = simulation.make_solver(choice);
    const double begin = bench::processor_seconds();
    while (solver->state().time < timed) solver->advance();
    least = std::min(least, (bench::processor_seconds() - begin) / solver->state().time);
    iterations = static_cast<double>(solver->solve_counts().iterations) / static_cast<double>(solver->steps());
  }
  return least;
}

Measurement measure(const Case& which) {
  const cli::Scene scene = scene_of(BILLOW_SOURCE_DIR "/scenes/drape.yaml", which);
  const cli::Simulation simulation(scene);
  const cli::StepChoice choice = simulation.choose_step();
  Measurement result;
  result.label = which.label;
  result.step = choice.step;
  result.motion = watch(scene, simulation, choice);
  if (result.motion) result.cost = cost_of(simulation, choice, result.iterations);
  return result;
}

void print_table(const std::vector<Measurement>& all) {
  fmt::print("{:<42} {:>8} {:>10} {:>8} {:>11} {:>6} {:>8}\n", "the drape at k0 = 1e6", "step, ms", "computing",
             "saved", "iterations", "swing", "lost");
  for (const Measurement& m : all) {
    if (!m.motion) {
      fmt::print("{:<42} {:>8.3f} {:>10}\n", m.label, 1e3 * m.step, "diverged");
      continue;
    }
    fmt::print("{:<42} {:>8.3f} {:>10.4f} {:>6.0f} % {:>11.1f} {:>6.2f} {:>6.1f} %\n", m.label, 1e3 * m.step, m.cost,
               100.0 * (1.0 - m.cost / all[1].cost), m.iterations, m.motion->swing, 100.0 * m.motion->lost);
  }
  fmt::print(
      "\ncomputing: seconds of one processor per simulated second; saved: of {}'s; swing: how far the centre of mass\n"
      "swings out at its third turn, over the first; lost: energy after {:.0f} s, of the weight times the size (there "
      "is\n"
      "no friction here, so all of it went to the scheme and the filter)\n",
      all[1].label, simulated);
}

void print_json(const std::vector<Measurement>& all) {
  nlohmann::ordered_json json = nlohmann::json::array();
  for (const Measurement& m : all)
    json.push_back({{"case", m.label},
                    {"step", m.step},
                    {"diverged", !m.motion},
                    {"seconds_per_simulated_second", m.cost},
                    {"iterations_per_step", m.iterations},
                    {"swing", m.motion.value_or(Motion{}).swing},
                    {"energy_lost", m.motion.value_or(Motion{}).lost}});
  fmt::print("{}\n", json.dump(1));
}

int run(bool as_json) {
  std::vector<Measurement> all;
  for (const Case& which : cases()) all.push_back(measure(which));
  as_json ? print_json(all) : print_table(all);
  return 0;
}

}  // namespace
}  // namespace billow

int main(int argc, char** argv) { return billow::bench::report_main(argc, argv, billow::run); }
