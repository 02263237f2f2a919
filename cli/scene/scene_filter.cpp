// lambda of every particle, and the ratio of levels.
#include "cli/scene/scene_filter.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "cli/scene/linearised_scene.h"
#include "cli/scene/particle_expression.h"
#include "cli/scene/scene_parts.h"
#include "sim/limit/certificate.h"

namespace billow::cli {

namespace {

constexpr double wanted_step = 0.008;     // [s] as true on the drape as backward Euler at 0.01 s
constexpr double most_chosen = 10.0;      // ratio, where the scene gives no step (docs/method.md, "Levels")
constexpr int most_corrections = 6;       // of a ratio, as damping is filtered too
constexpr double ratio_tolerance = 3e-3;  // relative

Eigen::VectorXd lambda_at_particles(const Scene& scene, const sim::Structure& structure) {
  Eigen::VectorXd lambda(structure.particles());
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const sim::Body& body = structure.body[b];
    const Eigen::MatrixX3d position = structure.rest_position.middleRows(body.first_particle, body.particles);
    lambda.segment(body.first_particle, body.particles) =
        evaluate_at_particles(scene.solver.lambda_expression, position, particle_mesh(scene.bodies[b]));
  }
  if (!(lambda.minCoeff() > 0.0)) throw InputError("lambda must be positive at every particle");
  return lambda;
}

/// Step limits for any shape under levels of one ratio or another.
class LevelLimits {
 public:
  LevelLimits(const Scene& scene, const sim::Structure& structure, const sim::Forces& forces)
      : scene_(scene),
        structure_(structure),
        bound_(forces.bound(sim::Shapes::any).linearisation),
        least_damping_(forces.least_damping()) {}

  /// Infinite where there is none.
  double limit(const sim::Filter* filter) const {
    const sim::CertifiedStep found =
        sim::certified_step(linearised_step(scene_, structure_, bound_, filter, &least_damping_));
    return found.unlimited ? INFINITY : found.step;
  }

  sim::Filter with_ratio(double ratio) const {
    sim::FilterOptions options = *scene_.solver.filter;
    options.ratio = ratio;
    return {structure_, options};
  }

 private:
  const Scene& scene_;
  const sim::Structure& structure_;
  sim::Linearisation bound_;
  sim::StiffnessMatrix least_damping_;
};

// Levels for `ratio`, or for as much of it as a body of few particles has levels for.
std::optional<sim::Filter> strongest_levels(const LevelLimits& limits, double ratio) {
  constexpr double retreat = 0.85;
  for (; ratio > 1.0; ratio *= retreat) {
    try {
      return limits.with_ratio(ratio);
    } catch (const InputError&) {
      continue;
    }
  }
  return std::nullopt;
}

std::optional<sim::Filter> weakest_levels(const SolverSpec& solver, const LevelLimits& limits) {
  const bool given = solver.step_rule == StepRule::fixed;
  const double wanted = (given ? solver.step : wanted_step) / solver.safety;
  const double unfiltered = limits.limit(nullptr);
  if (unfiltered >= wanted) return std::nullopt;
  if (unfiltered == 0.0)
    throw InputError(fmt::format("{} grows at every step here, which no levels change; use another method",
                                 sim::name(solver.method)));
  double ratio = wanted / unfiltered;
  if (!given) return strongest_levels(limits, std::min(ratio, most_chosen));
  std::optional<sim::Filter> weakest;
  for (int k = 0; k < most_corrections; ++k) {
    sim::Filter filter = limits.with_ratio(ratio);
    const double limit = limits.limit(&filter);
    if (limit >= wanted && (!weakest || ratio < weakest->options().ratio)) weakest.emplace(std::move(filter));
    if (limit >= wanted && limit <= wanted * (1.0 + 2.0 * ratio_tolerance)) break;
    ratio = std::max(1.0, ratio * wanted / limit * (1.0 + ratio_tolerance));
  }
  if (weakest) return weakest;
  throw InputError(
      fmt::format("no levels allow a step of {:.4g} s, as damping or friction bounds it too; take a smaller one, or "
                  "'step: auto'",
                  solver.step));
}

}  // namespace

std::optional<sim::Filter> make_filter(const Scene& scene, const sim::Structure& structure, const sim::Forces& forces) {
  const SolverSpec& solver = scene.solver;
  if (!solver.filter) return std::nullopt;
  return located(solver.filter_where, [&]() -> std::optional<sim::Filter> {
    if (solver.levels_choose) return weakest_levels(solver, LevelLimits(scene, structure, forces));
    sim::FilterOptions options = *solver.filter;
    if (!solver.lambda_expression.empty()) options.particle_lambda = lambda_at_particles(scene, structure);
    return sim::Filter(structure, options);
  });
}

}  // namespace billow::cli
