// The runs of a study.
#include "cli/study/study.h"

#include <fmt/format.h>

#include <algorithm>

namespace billow::cli {

Words<PictureKind> words(PictureKind) {
  static constexpr Word<PictureKind> list[] = {{"strips", PictureKind::strips},
                                               {"spectra", PictureKind::spectra},
                                               {"frames", PictureKind::frames},
                                               {"plot", PictureKind::plot},
                                               {"spectrum_curves", PictureKind::spectrum_curves}};
  return list;
}

bool is_plot(const PictureSpec& picture) {
  return picture.kind == PictureKind::plot || picture.kind == PictureKind::spectrum_curves;
}

std::vector<std::string> files_of(const PictureSpec& picture) {
  std::vector<std::string> files = {picture.name + ".png"};
  if (is_plot(picture)) files.insert(files.end(), {picture.name + ".svg", picture.name + ".csv"});
  return files;
}

std::vector<StudyRun> runs_of(const Study& study) {
  std::vector<StudyRun> runs{{1, {}}};
  for (const Axis& axis : study.axes) {
    std::vector<StudyRun> longer;
    for (const StudyRun& run : runs)
      for (std::size_t v = 0; v < axis.values.size(); ++v) {
        longer.push_back(run);
        longer.back().choice.push_back(static_cast<int>(v));
      }
    runs = std::move(longer);
  }
  for (std::size_t r = 0; r < runs.size(); ++r) runs[r].number = static_cast<int>(r) + 1;
  return runs;
}

std::vector<Override> overrides_of(const Study& study, const StudyRun& run) {
  std::vector<Override> all = study.base;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const std::vector<Override>& changes = study.axes[a].values[run.choice[a]].changes;
    all.insert(all.end(), changes.begin(), changes.end());
  }
  return all;
}

std::string label_of(const Study& study, const StudyRun& run) {
  std::vector<std::string> labels;
  for (std::size_t a = 0; a < study.axes.size(); ++a) labels.push_back(study.axes[a].values[run.choice[a]].label);
  return labels.empty() ? "the scene itself" : fmt::format("{}", fmt::join(labels, ", "));
}

bool selects(const PictureSpec& picture, const StudyRun& run) {
  return std::all_of(picture.where.begin(), picture.where.end(), [&](const Selection& s) {
    return std::find(s.values.begin(), s.values.end(), run.choice[s.axis]) != s.values.end();
  });
}

bool comes_first(const PictureSpec& picture, const StudyRun& a, const StudyRun& b) {
  return picture.rows && a.choice[*picture.rows] < b.choice[*picture.rows];
}

}  // namespace billow::cli
