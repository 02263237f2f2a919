// Doing a study's runs, together with whoever else is at the same study.
#pragma once

#include <vector>

#include "cli/study/study_plan.h"

namespace billow::cli {

/// A run that is to be done, whatever result it has.
struct DueRun {
  int number = 0;
  ResultStamp before;  // of the result that it had, taken before that was looked at
};

/// Does the runs `due`, at most `jobs` at a time; says of each what it came to. Any number of processes, on any
/// machines that share the folder, may do this at one time: each run is claimed before it is begun, so that one of them
/// does it, and this returns when each has another result than before, whoever did it. A run that leaves no result has
/// failed, which is written down as its result. Stops early when a signal asks for it. Throws as run_jobs and
/// take_claim.
void do_runs(const StudyPlan& plan, const std::vector<DueRun>& due, int jobs);

}  // namespace billow::cli
