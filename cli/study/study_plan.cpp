// Runs and their places.
#include "cli/study/study_plan.h"

#include <fmt/format.h>

#include "cli/scene/scene_parts.h"
#include "cli/study/study_run.h"

namespace billow::cli {

std::string StudyPlan::name_of(int number) const {
  return fmt::format("run {}, {}", number, label_of(study, run(number)));
}

RunResult StudyPlan::result_of(int number) const {
  return read_result(folder_of(number), hash[static_cast<std::size_t>(number) - 1]);
}

StudyPlan make_plan(const std::filesystem::path& study, const std::filesystem::path& folder) {
  StudyPlan plan{read_study(study), folder, {}, {}};
  if (plan.folder.empty()) plan.folder = std::filesystem::path("out") / study.stem();
  plan.runs = runs_of(plan.study);
  plan.hash.resize(plan.runs.size());
  return plan;
}

void read_hash(StudyPlan& plan, int number) {
  plan.hash[static_cast<std::size_t>(number) - 1] =
      run_hash(plan.study, read_scene(plan.study.scene, overrides_of(plan.study, plan.run(number))));
}

bool is_finished(const RunResult& result) {
  return result.status == RunStatus::done || result.status == RunStatus::diverged;
}

}  // namespace billow::cli
