// A study's unfinished runs, for other processes to do.
#pragma once

#include <vector>

#include "cli/cluster/spread.h"
#include "cli/study/study_plan.h"

namespace billow::cli {

/// Prints commands or a Slurm script that do the runs `unfinished`, or submits that, as `options` say. Throws as
/// hand_over.
void spread_study(const StudyPlan& plan, const std::vector<long>& unfinished, const SpreadOptions& options);

}  // namespace billow::cli
