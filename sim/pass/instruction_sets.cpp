// Highway's own tables.
#include "sim/pass/instruction_sets.h"

#include <hwy/targets.h>

namespace billow::sim {

std::vector<std::string> compiled_instruction_sets() {
  std::vector<std::string> names;
  for (std::int64_t sets = HWY_TARGETS; sets != 0; sets &= sets - 1)  // the lowest bit is the best
    names.emplace_back(hwy::TargetName(sets & ~(sets - 1)));
  return names;
}

std::string chosen_instruction_set() { return hwy::TargetName(hwy::SupportedAndGeneratedTargets().front()); }

}  // namespace billow::sim
