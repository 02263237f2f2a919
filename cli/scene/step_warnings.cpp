// Words for what a choice of step leaves open.
#include "cli/scene/step_warnings.h"

#include <fmt/format.h>

namespace billow::cli {

std::vector<std::string> step_warnings(const sim::Structure& structure, const StepChoice& choice) {
  std::vector<std::string> warnings;
  if (choice.limit && choice.step > *choice.limit)
    warnings.push_back(fmt::format("the step is {:.4g} s, above the certified limit of {:.4g} s; the run may diverge",
                                   choice.step, *choice.limit));
  for (const std::string& law : choice.unbounded)
    warnings.push_back(fmt::format("the step limit does not count {}, which has no bound; the run may diverge", law));
  if (choice.only_at_rest)
    warnings.emplace_back(
        "the step is certified at rest only: damping along springs leaves motion across stretched ones undamped, which "
        "this method makes grow; friction or another method would hold it");
  if (choice.always_grows)
    warnings.emplace_back("this filter makes some motion grow slowly whatever the step; 'form: conserving' does not");
  if (!choice.k0.converged) warnings.emplace_back("the search for k0 did not settle; it may be a little too low");
  if (choice.setter) warnings.push_back(sim::text_of(structure, *choice.setter));
  return warnings;
}

}  // namespace billow::cli
