// Reading, running, and choosing what is compared.
#include "cli/golden/golden_render.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/process_start.h"
#include "base/regular_file.h"
#include "cli/run/contact_sheet.h"
#include "cli/run/render_scene.h"
#include "cli/run/watched_scene.h"
#include "cli/scene/scene_parts.h"
#include "cli/scene/simulation.h"
#include "cli/text/command_text.h"
#include "render/image/png.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t frames_of_a_sheet = 12;  // as of `billow sheet`

bool compares(const RenderedPictures& test, RunPicture kind) {
  return std::find(test.kinds.begin(), test.kinds.end(), kind) != test.kinds.end();
}

/// Frames that a test looks at; a sheet's are among those that the test names.
struct TestedFrames {
  std::vector<long> compared, on_sheet;
};

TestedFrames frames_of(const RenderedPictures& test, const Scene& scene) {
  TimedFrames named;
  const std::vector<FrameSpan> spans = test.frames.empty() ? std::vector<FrameSpan>{FrameSpan{}} : test.frames;
  for (const long frame : located(
           test.frames_where, [&] { return numbers_in(spans, frame_count(scene), "frames", "the scene has frames"); }))
    named.emplace_back(frame, 0.0);
  TestedFrames frames;
  if (compares(test, RunPicture::frames))
    for (const auto& [frame, time] : named) frames.compared.push_back(frame);
  if (compares(test, RunPicture::sheet))
    for (const auto& [frame, time] : evenly_chosen(named, frames_of_a_sheet)) frames.on_sheet.push_back(frame);
  return frames;
}

// The pictures of the whole run, and the files that they are.
std::vector<RunFile> whole_pictures(const RenderedPictures& test) {
  std::vector<RunFile> files;
  if (compares(test, RunPicture::strip)) files.push_back(RunFile::strip);
  if (compares(test, RunPicture::velocity_image)) files.push_back(RunFile::velocity_image);
  if (compares(test, RunPicture::spectrum)) files.push_back(RunFile::spectrum);
  return files;
}

void check_kinds(const RenderedPictures& test, const Scene& scene) {
  const auto lacks = [&](RunPicture kind, std::string_view section) {
    fail_at(test.kinds_where,
            fmt::format("the scene makes no {0}; give it a '{1}', like set: {{{1}: {{}}}}", word_of(kind), section));
  };
  if (compares(test, RunPicture::sheet) &&
      std::none_of(scene.render.views.begin(), scene.render.views.end(), render::is_png))
    fail_at(test.kinds_where, "a sheet is of PNG views, and none is drawn; give the test 'views', like [textured]");
  if (compares(test, RunPicture::strip) && !scene.strip) lacks(RunPicture::strip, "strip");
  for (const RunPicture kind : {RunPicture::velocity_image, RunPicture::spectrum})
    if (compares(test, kind) && !scene.spectrum) lacks(kind, "spectrum");
}

// Only what a frame or a sheet needs is drawn. A run is as long as its last frame says, so the pictures of all of it
// need that one too.
std::vector<FrameSpan> drawn_frames(const RenderedPictures& test, const TestedFrames& frames, const Scene& scene) {
  std::vector<FrameSpan> spans;
  for (const std::vector<long>* wanted : {&frames.compared, &frames.on_sheet})
    for (const long frame : *wanted) spans.push_back({frame, frame, 1});
  if (!whole_pictures(test).empty()) spans.push_back({frame_count(scene), frame_count(scene), 1});
  return spans;
}

std::vector<Override> changes_of(const RenderedPictures& test) {
  std::vector<Override> changes = test.changes;
  std::vector<std::string_view> names;
  for (const render::View view : test.views) names.push_back(word_of(view));
  if (!names.empty()) changes.push_back({"render.views", fmt::format("[{}]", fmt::join(names, ", "))});
  return changes;
}

// The run by hand, but for its frames.
std::string command_of(const RenderedPictures& test) {
  std::vector<std::string> words = {"billow", "render", test.scene.lexically_normal().string()};
  add_overrides(changes_of(test), words);
  return command_line(words);
}

void keep(const fs::path& film, const fs::path& file, const fs::path& pictures) {
  make_folder_within(pictures, file.parent_path());
  write_file_atomically(pictures / file, read_regular_file(film / file));
}

void write_sheet(const fs::path& film, const std::vector<long>& frames, render::View view, const fs::path& pictures) {
  FinishedRun run = read_finished_run(film);
  std::erase_if(run.frames,
                [&](const auto& frame) { return !std::binary_search(frames.begin(), frames.end(), frame.first); });
  render::write_png(pictures / (joined_names({view}) + "_sheet.png"), contact_sheet(run, {view}, run.frames, 0));
}

void keep_pictures(const RenderedPictures& test, const Scene& scene, const TestedFrames& frames, const fs::path& film,
                   const fs::path& pictures) {
  for (const render::View view : scene.render.views) {
    for (const long frame : frames.compared) keep(film, frame_of("", view, frame), pictures);
    if (!frames.on_sheet.empty() && render::is_png(view)) write_sheet(film, frames.on_sheet, view, pictures);
  }
  for (const RunFile file : whole_pictures(test)) keep(film, word_of(file), pictures);
}

}  // namespace

int render_pictures(const RenderedPictures& test, const fs::path& film, const fs::path& pictures,
                    const render::Backend& backend, int threads) {
  Progress progress(ProgressStyle::plain, process_start());
  const Scene scene = read_scene(test.scene, changes_of(test), progress);
  check_kinds(test, scene);
  const TestedFrames frames = frames_of(test, scene);
  progress.phase("springs");
  const Simulation simulation(scene);
  progress.phase("limit");
  RenderOptions options;
  options.scene = test.scene;
  options.output = film;
  options.existing = Existing::overwrite;
  options.threads = threads;
  options.backend = backend;
  options.frames = drawn_frames(test, frames, scene);
  options.command = command_of(test);
  const int status = render_scene(scene, simulation, simulation.choose_step(), options, progress);
  if (status == 0) keep_pictures(test, scene, frames, film, pictures);
  return status;
}

}  // namespace billow::cli
