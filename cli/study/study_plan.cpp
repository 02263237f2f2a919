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
  plan.offer.resize(plan.runs.size());
  return plan;
}

void read_hash(StudyPlan& plan, int number) {
  const Scene scene = read_scene(plan.study.scene, overrides_of(plan.study, plan.run(number)));
  plan.hash[static_cast<std::size_t>(number) - 1] = run_hash(plan.study, scene);
  RunOffer offer{scene.duration, scene.strip.has_value(), scene.spectrum.has_value(), {}};
  for (const render::View view : scene.render.views) offer.views.emplace_back(render::name(view));
  plan.offer[static_cast<std::size_t>(number) - 1] = std::move(offer);
}

namespace {

// What a picture does not find in the scene of one of its runs, and what to do; empty where it finds all. Below strips
// are frames of the first run alone, in one view.
std::string lacking(const PictureSpec& picture, const RunOffer& offer, bool is_first) {
  const bool is_strip = picture.kind == PictureKind::strips;
  const bool is_spectrum = picture.kind == PictureKind::spectra || picture.kind == PictureKind::spectrum_curves;
  const std::string needed = is_strip && !offer.strip ? "strip" : is_spectrum && !offer.spectrum ? "spectrum" : "";
  if (!needed.empty()) return fmt::format("no {0}; give it one with '{0}: {{}}'", needed);
  if (picture.times.empty() || (is_strip && !is_first)) return "";
  for (const std::string& view : is_strip ? std::vector{picture.views.front()} : picture.views)
    if (std::find(offer.views.begin(), offer.views.end(), view) == offer.views.end())
      return fmt::format("no view '{}'; add it to render.views", view);
  return "";
}

// The runs of a picture, in its order.
std::vector<const StudyRun*> runs_of_picture(const StudyPlan& plan, const PictureSpec& picture) {
  std::vector<const StudyRun*> runs;
  for (const StudyRun& run : plan.runs)
    if (selects(picture, run)) runs.push_back(&run);
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const StudyRun* a, const StudyRun* b) { return comes_first(picture, *a, *b); });
  return runs;
}

void check_offers(const StudyPlan& plan, const PictureSpec& picture) {
  const std::vector<const StudyRun*> runs = runs_of_picture(plan, picture);
  for (const StudyRun* run : runs) {
    const std::optional<RunOffer>& offer = plan.offer[static_cast<std::size_t>(run->number) - 1];
    if (!offer) continue;
    if (const std::string lacks = lacking(picture, *offer, run == runs.front()); !lacks.empty())
      throw InputError(fmt::format("{}: for the picture '{}' the scene of run {} has {}", picture.place, picture.name,
                                   run->number, lacks));
  }
}

void check_times(const StudyPlan& plan, const PictureSpec& picture) {
  constexpr double rounding = 1e-9;
  double longest = 0.0;
  for (const StudyRun& run : plan.runs) {
    if (!selects(picture, run)) continue;
    const std::optional<RunOffer>& offer = plan.offer[static_cast<std::size_t>(run.number) - 1];
    if (!offer) return;
    longest = std::max(longest, offer->duration);
  }
  for (std::size_t k = 0; longest > 0.0 && k < picture.times.size(); ++k)
    if (picture.times[k] > longest * (1.0 + rounding))
      throw InputError(
          fmt::format("{}: the picture '{}' wants a frame at {} s, and its runs end at {} s; give earlier times, or a "
                      "longer duration",
                      picture.times_where[k], picture.name, picture.times[k], longest));
}

}  // namespace

void check_pictures(const StudyPlan& plan) {
  for (const PictureSpec& picture : plan.study.pictures) {
    check_offers(plan, picture);
    check_times(plan, picture);
  }
}

bool is_finished(const RunResult& result) {
  return result.status == RunStatus::done || result.status == RunStatus::diverged;
}

}  // namespace billow::cli
