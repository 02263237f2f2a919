// Warnings at the end of a run.
#include "cli/run/run_warnings.h"

#include <fmt/format.h>

#include "cli/run/incident_text.h"

namespace billow::cli {

namespace {

using Warnings = std::vector<std::string>;

// What the conjugate gradient could not do, and what to do instead. Tightening alone costs little and mends all.
void add_warnings_of_solves(const sim::SolveCounts& solves, Warnings& warnings) {
  if (solves.by_cholesky > 0)
    warnings.push_back(
        fmt::format("the conjugate gradient gave up on {} of {} linear solves, which sparse Cholesky took over; choose "
                    "'solver.linear_solver: cholesky', raise solver.max_iterations or take a smaller step",
                    solves.by_cholesky, solves.solves));
  if (solves.failures > 0)
    warnings.push_back(fmt::format(
        "{} of {} linear solves failed, by Cholesky too, so the motion is wrong from the first of them on; take a "
        "smaller step or softer springs",
        solves.failures, solves.solves));
}

// Below it, motion that one sees is slowed by as much again as its response's root.
constexpr double least_response = 0.9;

}  // namespace

std::vector<std::string> run_warnings(const Run& run, const FilmReport& report) {
  Warnings warnings;
  for (const sim::Incident& incident : report.facts.incidents)
    warnings.push_back(incident_text(incident, run.choice.step));
  if (report.facts.largest_strain > sim::suspect_strain)
    warnings.push_back(
        fmt::format("a spring was stretched by {:.3g} times its rest length, which its stiffness allowed",
                    report.facts.largest_strain));
  if (report.filter_response && *report.filter_response < least_response)
    warnings.push_back(
        fmt::format("the filter passes {:.0f} % of the motion's own accelerations, so that what one sees is slowed; "
                    "take a smaller ratio, a larger lambda or fewer passes",
                    100.0 * *report.filter_response));
  add_warnings_of_solves(report.facts.solves, warnings);
  return warnings;
}

}  // namespace billow::cli
