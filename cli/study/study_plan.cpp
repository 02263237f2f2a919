// Runs and their places.
#include "cli/study/study_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "cli/scene/scene_parts.h"
#include "cli/study/study_run.h"

namespace billow::cli {

std::string StudyPlan::name_of(int number) const {
  return fmt::format("run {}, {}", number, label_of(study, run(number)));
}

RunResult StudyPlan::result_of(int number) const {
  return read_result(folder_of(number), hash[static_cast<std::size_t>(number) - 1]);
}

std::filesystem::path usual_folder(const std::filesystem::path& study) {
  return std::filesystem::path("out") / study.stem();
}

StudyPlan make_plan(const std::filesystem::path& study, const std::filesystem::path& folder) {
  StudyPlan plan{read_study(study), folder, {}, {}, {}};
  if (plan.folder.empty()) plan.folder = usual_folder(study);
  plan.runs = runs_of(plan.study);
  plan.hash.resize(plan.runs.size());
  plan.duration.resize(plan.runs.size());
  return plan;
}

void read_hash(StudyPlan& plan, int number) {
  const Scene scene = read_scene(plan.study.scene, overrides_of(plan.study, plan.run(number)));
  plan.hash[static_cast<std::size_t>(number) - 1] = run_hash(plan.study, scene);
  plan.duration[static_cast<std::size_t>(number) - 1] = scene.duration;
}

void check_times(const StudyPlan& plan) {
  constexpr double rounding = 1e-9;
  for (const PictureSpec& picture : plan.study.pictures) {
    double longest = 0.0;
    bool all_read = true;
    for (const StudyRun& run : plan.runs) {
      if (!selects(picture, run)) continue;
      const double duration = plan.duration[static_cast<std::size_t>(run.number) - 1];
      all_read = all_read && duration > 0.0;
      longest = std::max(longest, duration);
    }
    for (std::size_t k = 0; all_read && longest > 0.0 && k < picture.times.size(); ++k)
      if (picture.times[k] > longest * (1.0 + rounding))
        throw InputError(
            fmt::format("{}: the picture '{}' wants a frame at {} s, and its runs end at {} s; give "
                        "earlier times, or a longer duration",
                        picture.times_where[k], picture.name, picture.times[k], longest));
  }
}

bool is_finished(const RunResult& result) {
  return result.status == RunStatus::done || result.status == RunStatus::diverged;
}

}  // namespace billow::cli
