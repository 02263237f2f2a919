// A run's facts as text.
#include "cli/run/run_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/readable_number.h"
#include "cli/run/output_folder.h"
#include "cli/scene/filter_text.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

std::string counts_text(const sim::Structure& structure) {
  return fmt::format("{}, {}", counted(structure.particles(), "particle"), counted(structure.springs(), "spring"));
}

std::string summary(const Run& run) {
  return fmt::format("{}; {} at {:.4g} s a step; filter: {}", counts_text(run.simulation.structure()),
                     sim::name(run.scene.solver.method), run.choice.step, filter_text(run.scene, run.simulation));
}

std::string limit_text(const std::optional<double>& limit) { return limit ? fmt::format("{:.4g} s", *limit) : "none"; }

std::string limits_text(const StepChoice& choice) {
  return fmt::format("paper {}, certified at rest {}, certified for any shape {}", limit_text(choice.paper),
                     limit_text(choice.certified), limit_text(choice.any_shape));
}

std::string solves_text(const sim::SolveCounts& solves) {
  std::string text = fmt::format("{}, {:.3g} iterations each", grouped(solves.solves),
                                 static_cast<double>(solves.iterations) / static_cast<double>(solves.solves));
  if (solves.tightened > 0)
    text += fmt::format(", {} beyond their tolerance to keep the energy from rising", grouped(solves.tightened));
  if (solves.by_cholesky > 0) text += fmt::format(", {} handed to Cholesky", grouped(solves.by_cholesky));
  return text + fmt::format(", {} not solved", grouped(solves.failures));
}

std::string images_text(const FilmReport& report) {
  const std::string kept =
      report.images_kept ? fmt::format(", {} kept from an earlier run", grouped(report.images_kept)) : "";
  return fmt::format("{} written{}; {}", grouped(report.images_written), kept,
                     counted(report.strip_columns, "strip column"));
}

std::string caches_text(const std::vector<CacheRecord>& caches) {
  std::string text;
  for (const CacheRecord& cache : caches)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", cache.file.string(), counted(cache.frames, "frame"));
  return text;
}

std::string pictures_text(const Scene& scene) {
  return fmt::format("{}: {:g} s at {:g} a second, {} × {} pixels", counted(frame_count(scene), "frame"),
                     scene.duration, scene.render.fps, scene.render.width, scene.render.height);
}

// What is known before the first step.
Facts facts_of_scene(const Run& run) {
  const Scene& scene = run.scene;
  const StepChoice& choice = run.choice;
  Facts facts{{"Scene", fmt::format("{} (hash {})", scene.file.string(), scene.hash)},
              {"Film", pictures_text(scene)},
              {"Structure", counts_text(run.simulation.structure())},
              {"Highest eigenvalue k0", fmt::format("{} s⁻²{}", readable(choice.k0.value, 4),
                                                    choice.k0.converged ? "" : " (the search did not settle)")}};
  if (choice.filtered) facts.emplace_back("With the filter", readable(choice.filtered->value, 4) + " s⁻²");
  facts.insert(facts.end(), {{"Method", std::string(sim::name(scene.solver.method))},
                             {"Filter", filter_text(run.scene, run.simulation)},
                             {"Step", fmt::format("{:.4g} s ({})", choice.step, choice.bound)},
                             {"Step limits", limits_text(choice)}});
  return facts;
}

void add_facts_of_film(const Run& run, const FilmReport& report, const Progress& progress, Facts& facts) {
  facts.emplace_back("Simulated", fmt::format("{:.4g} s of {:.4g} s in {}", report.simulated_time, run.scene.duration,
                                              counted(report.facts.steps, "step")));
  if (report.facts.solves.solves > 0) facts.emplace_back("Linear solves", solves_text(report.facts.solves));
  if (!report.caches.empty()) facts.emplace_back("Geometry caches", caches_text(report.caches));
  facts.emplace_back("Velocity colours", fmt::format("up to {} m/s", readable(report.velocity_range, 4)));
  facts.emplace_back("Images", images_text(report));
  facts.emplace_back("Time taken", time_taken(progress, report));
  if (!report.gl.empty()) facts.emplace_back("Drawn by", fmt::format("{}: {}", report.backend, report.gl));
}

// Has the page show the model that the run's folder holds.
void show_model(RunPage& page) {
  page.glb = word_of(RunFile::glb);
  page.glb_script = word_of(RunFile::glb_script);
}

bool has_option(const Run& run, std::string_view option) {
  return (run.command + " ").find(fmt::format(" {} ", option)) != std::string::npos;
}

// The command into the folder that holds the run by now.
std::string command_again(const Run& run) {
  const bool goes_there =
      run.command.empty() || has_option(run, "--overwrite") || has_option(run, "--resume") || has_option(run, "--from");
  return run.command + (goes_there ? "" : " --overwrite");
}

// How the missing frames are had.
std::string how_to_go_on(const Run& run) {
  if (has_option(run, "--from")) return "The same command draws the others.";
  const bool replaces = !has_option(run, "--resume");
  return fmt::format("The same command with --resume{} goes on from there.",
                     replaces ? " in place of --overwrite" : "");
}

// What a run that fell short has to show for it, as a line of its own.
std::string what_is_there(const RunPage& page, const FilmFrames& frames) {
  if (page.series.last_frame() == 0 && page.listed.empty())
    return frames.states_alone ? "\nThe states until then are kept." : "\nNo frame was drawn.";
  const std::string drawn = page.listed.empty()
                                ? frames_text(FrameRange{page.series.first_frame(), page.series.last_frame(), {}})
                                : frames_text(page.listed);
  return fmt::format("\nFrames that were {}: {} of {}.", frames.states_alone ? "kept" : "drawn", drawn,
                     grouped(page.frames));
}

// Why the run has fewer frames than it was asked for; empty where it has them all.
std::string shortfall(const Run& run, const FilmReport& report) {
  if (report.divergence) return "This run did not finish: " + *report.divergence + ".";
  if (!report.interrupted_by) return "";
  return fmt::format("This run was interrupted by SIG{} at {:.4g} s of {:.4g} s.", sigabbrev_np(report.interrupted_by),
                     report.simulated_time, run.scene.duration);
}

// A page that shows a part on purpose says so.
void note_part(const FilmFrames& frames, RunPage& page) {
  const auto add = [&](const std::string& text) { page.notes.push_back({PageNote::Kind::partial, text}); };
  const std::string total = grouped(page.frames);
  if (frames.there) {
    if (static_cast<long>(frames.there->size()) == page.frames) return;
    const std::string drawn = frames.there->empty() ? "none" : frames_text(*frames.there);
    add(fmt::format("Drawn so far, of {}: {}. The curves are of all.", counted(page.frames, "frame"), drawn));
  } else if (frames.asked.count() < page.frames) {
    const char* const curves = page.scattered ? " The lines of the curves join them across what lies between." : "";
    add(fmt::format("A part of the run, as asked for: {} {} of {}.{}", frames.asked.count() == 1 ? "frame" : "frames",
                    frames_text(frames.asked), total, curves));
  }
}

// Those of the frames asked for that the run has come to.
std::vector<long> listed_of(const FilmFrames& frames, const RunSeries& series) {
  if (frames.there) return *frames.there;
  std::vector<long> listed = frames.asked.listed;
  listed.erase(std::upper_bound(listed.begin(), listed.end(), series.last_frame()), listed.end());
  return listed;
}

// Views that a browser can show, or why there are none.
void set_views(const Scene& scene, const FilmFrames& frames, RunPage& page) {
  if (frames.states_alone) {
    page.no_views = "No pictures: the states alone were kept. 'billow render' draws any frames of them with --from.";
    return;
  }
  for (const render::View view : scene.render.views) {
    if (render::is_png(view))
      page.views.emplace_back(render::folder(view));
    else
      page.no_views +=
          fmt::format("Frames of the view '{0}' are in the folder {0}, in a format that browsers do not show.",
                      render::folder(view));
  }
}

RunPage page_of(const Run& run, const FilmFrames& frames) {
  const Scene& scene = run.scene;
  RunPage page;
  page.title = scene.file.stem().string();
  page.summary = summary(run);
  set_views(scene, frames, page);
  page.width = scene.render.width;
  page.height = scene.render.height;
  page.fps = scene.render.fps;
  page.frames = frame_count(scene);
  page.facts = facts_of_scene(run);
  page.command = command_again(run);
  page.scene = scene.effective;
  return page;
}

void end_page(const std::vector<std::string>& warnings, RunPage& page) {
  for (const std::string& warning : warnings)
    page.notes.push_back({PageNote::Kind::look_closer, "Warning: " + warning});
  page.facts.emplace_back("billow", version());
}

}  // namespace

std::string time_taken(const Progress& progress, const FilmReport& report) {
  std::string phases;
  for (const auto& [name, seconds] : progress.phases()) {
    phases += fmt::format("{}{} {:.2f}", phases.empty() ? "" : ", ", name, seconds);
    if (name == "render")
      phases += fmt::format(", there side by side simulate {:.2f}, draw {:.2f}, encode {:.2f} over all threads",
                            report.simulate.wall, report.draw.wall, report.encode.wall);
  }
  return fmt::format("{:.2f} s ({})", progress.wall(), phases);
}

RunPage describe_run(const Run& run, const FilmReport& report, const FilmFrames& frames,
                     const std::vector<std::string>& warnings, const Progress& progress) {
  const Scene& scene = run.scene;
  RunPage page = page_of(run, frames);
  page.series = report.series;
  page.listed = listed_of(frames, report.series);
  page.scattered = !frames.there && !frames.asked.listed.empty();
  if (const std::string why = shortfall(run, report); !why.empty())
    page.notes.push_back({PageNote::Kind::failed,
                          why + what_is_there(page, frames) + (report.divergence ? "" : " " + how_to_go_on(run))});
  note_part(frames, page);
  page.strip_columns = report.strip_columns;
  page.strip_step = scene.strip ? scene.strip->step : 0.0;
  if (scene.spectrum && report.simulated_time >= scene.spectrum->at * (1.0 - 1e-9))
    page.spectrum_time = scene.spectrum->at;
  for (const CacheRecord& cache : report.caches)
    if (cache.format == CacheFormat::glb) show_model(page);
  add_facts_of_film(run, report, progress, page.facts);
  end_page(warnings, page);
  return page;
}

RunPage describe_unfinished_run(const Run& run, SuddenEnd how, const std::string& reason, const FilmFrames& frames,
                                const std::vector<std::string>& warnings) {
  RunPage page = page_of(run, frames);
  page.listed = frames.there.value_or(std::vector<long>());
  std::string text = how == SuddenEnd::failure ? "This run failed" : "This run was interrupted before its first frame";
  text += reason.empty() ? "." : ": " + reason + ".";
  page.notes.push_back({PageNote::Kind::failed, text + what_is_there(page, frames) + " " + how_to_go_on(run)});
  end_page(warnings, page);
  return page;
}

}  // namespace billow::cli
