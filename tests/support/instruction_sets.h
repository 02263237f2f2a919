// Vector code on every instruction set that the machine has.
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace billow::test {

/// Runs `work` on each instruction set in turn, named to a failing test.
template <class Work>
void on_every_instruction_set(const Work& work) {
  for (const std::int64_t set : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(set));
    hwy::SetSupportedTargetsForTest(set);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    work();
    hwy::SetSupportedTargetsForTest(0);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace billow::test
