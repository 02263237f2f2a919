// A picture's selection -> runs with labels and folders.
#include "cli/study/shown_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/text/command_text.h"

namespace billow::cli {

namespace fs = std::filesystem;

std::vector<int> varying_axes(const Study& study, const std::vector<ShownRun>& runs) {
  std::vector<int> varying;
  for (int a = 0; a < static_cast<int>(study.axes.size()); ++a)
    if (std::any_of(runs.begin(), runs.end(),
                    [&](const ShownRun& shown) { return shown.run->choice[a] != runs.front().run->choice[a]; }))
      varying.push_back(a);
  return varying;
}

std::string label_on(const Study& study, const std::vector<int>& axes, const StudyRun& run) {
  std::vector<std::string_view> labels;
  for (const int a : axes) labels.push_back(study.axes[a].values[run.choice[a]].shown);
  return fmt::format("{}", fmt::join(labels, ", "));
}

std::vector<ShownRun> shown_runs(const StudyContents& contents, const PictureSpec& picture) {
  std::vector<ShownRun> shown;
  for (std::size_t r = 0; r < contents.runs.size(); ++r) {
    const StudyRun& run = contents.runs[r];
    if (!selects(picture, run)) continue;
    shown.push_back({&run, &contents.results[r], run_folder(contents.folder, contents.study, run) / "film", "",
                     command_line({"billow", "study", contents.study.file.string(), "-o", contents.folder.string(),
                                   "--only", std::to_string(run.number)})});
  }
  const std::vector<int> axes = varying_axes(contents.study, shown);
  for (ShownRun& run : shown) run.label = label_on(contents.study, axes, *run.run);
  return shown;
}

std::vector<ShownRun> rendered_runs(const StudyContents& contents, const PictureSpec& picture) {
  std::vector<ShownRun> shown = shown_runs(contents, picture);
  std::erase_if(shown, [](const ShownRun& run) {
    return run.result->status == RunStatus::missing || run.result->status == RunStatus::failed;
  });
  for (ShownRun& run : shown)
    if (run.result->status == RunStatus::diverged) run.label += run.label.empty() ? "diverged" : " (diverged)";
  return shown;
}

std::string unfinished_runs(const std::vector<ShownRun>& runs) {
  constexpr std::size_t most_named = 3;
  std::vector<std::string> parts;
  for (const ShownRun& run : runs) {
    if (parts.size() == most_named) break;
    const bool failed = run.result->status == RunStatus::failed;
    parts.push_back(failed ? fmt::format("run {} failed ({})", run.run->number, run.result->message)
                           : fmt::format("run {} is missing", run.run->number));
  }
  return fmt::format("{}{}", fmt::join(parts, ", "), runs.size() > parts.size() ? ", …" : "");
}

void require_file(const fs::path& file) {
  const fs::path film = file.parent_path();
  std::error_code error;
  if (fs::exists(file, error)) return;
  const bool film_is_there = fs::exists(film / word_of(RunFile::record), error);
  throw InputError(fmt::format("{} is missing", (film_is_there ? file : film).string()));
}

FinishedRun finished_film(const ShownRun& run) {
  return of_run(run, run.film / word_of(RunFile::record), [&](const fs::path& record) {
    require_file(record);
    return read_finished_run(run.film);
  });
}

}  // namespace billow::cli
