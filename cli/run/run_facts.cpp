// A run's facts as text.
#include "cli/run/run_facts.h"

#include <fmt/format.h>

#include "cli/run/output_folder.h"
#include "cli/scene/filter_text.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

std::string summary(const Run& run) {
  const sim::Structure& structure = run.simulation.structure();
  return fmt::format("{} particles, {} springs; {} at {:.4g} s a step; filter: {}", structure.particles(),
                     structure.springs(), sim::name(run.scene.solver.method), run.choice.step,
                     filter_text(run.scene, run.simulation));
}

std::string limit_text(const std::optional<double>& limit) { return limit ? fmt::format("{:.4g} s", *limit) : "none"; }

std::string limits_text(const StepChoice& choice) {
  return fmt::format("paper {}, certified at rest {}, certified for any shape {}", limit_text(choice.paper),
                     limit_text(choice.certified), limit_text(choice.any_shape));
}

std::string solves_text(const sim::SolveCounts& solves) {
  std::string text = fmt::format("{}, {:.3g} iterations each", solves.solves,
                                 static_cast<double>(solves.iterations) / static_cast<double>(solves.solves));
  if (solves.tightened > 0)
    text += fmt::format(", {} beyond their tolerance to keep the energy from rising", solves.tightened);
  if (solves.by_cholesky > 0) text += fmt::format(", {} handed to Cholesky", solves.by_cholesky);
  return text + fmt::format(", {} not solved", solves.failures);
}

std::string images_text(const FilmReport& report) {
  const std::string kept = report.images_kept ? fmt::format(", {} kept from an earlier run", report.images_kept) : "";
  return fmt::format("{} written{}; {} strip columns", report.images_written, kept, report.strip_columns);
}

std::string caches_text(const std::vector<CacheRecord>& caches) {
  std::string text;
  for (const CacheRecord& cache : caches)
    text += fmt::format("{}{} ({} frames)", text.empty() ? "" : ", ", cache.file.string(), cache.frames);
  return text;
}

Facts facts_of(const Run& run, const FilmReport& report, const Progress& progress) {
  const Scene& scene = run.scene;
  const StepChoice& choice = run.choice;
  const sim::Structure& structure = run.simulation.structure();
  Facts facts{{"Scene", fmt::format("{} (hash {})", scene.file.string(), scene.hash)},
              {"Particles, springs", fmt::format("{}, {}", structure.particles(), structure.springs())},
              {"Highest eigenvalue k0", fmt::format("{:.4g} /s²{}", choice.k0.value,
                                                    choice.k0.converged ? "" : " (the search did not settle)")}};
  if (choice.filtered) facts.emplace_back("With the filter", fmt::format("{:.4g} /s²", choice.filtered->value));
  facts.insert(facts.end(), {{"Method", std::string(sim::name(scene.solver.method))},
                             {"Filter", filter_text(run.scene, run.simulation)},
                             {"Step", fmt::format("{:.4g} s ({})", choice.step, choice.bound)},
                             {"Step limits", limits_text(choice)},
                             {"Simulated", fmt::format("{:.4g} s of {:.4g} s in {} steps", report.simulated_time,
                                                       scene.duration, report.facts.steps)}});
  if (report.facts.solves.solves > 0) facts.emplace_back("Linear solves", solves_text(report.facts.solves));
  if (!report.caches.empty()) facts.emplace_back("Geometry caches", caches_text(report.caches));
  facts.insert(facts.end(), {{"Velocity colours", fmt::format("up to {:.4g} m/s", report.velocity_range)},
                             {"Images", images_text(report)},
                             {"Time taken", time_taken(progress, report)},
                             {"Drawn by", report.gl},
                             {"billow", std::string(version())}});
  return facts;
}

// Has the page show the model that the run's folder holds.
void show_model(RunPage& page) {
  page.glb = word_of(RunFile::glb);
  page.glb_script = word_of(RunFile::glb_script);
}

// Why the run has fewer frames than it was asked for; empty where it has them all.
std::string shortfall(const Scene& scene, const FilmReport& report) {
  if (report.divergence) return "This run did not finish: " + *report.divergence + ".";
  if (!report.interrupted_by) return "";
  return fmt::format(
      "This run was interrupted at {:.4g} s of {:.4g} s. Unless it drew a range of frames only, --resume "
      "finishes it.",
      report.simulated_time, scene.duration);
}

std::vector<PageNote> notes_of(const Scene& scene, const FilmReport& report, const std::vector<std::string>& warnings) {
  std::vector<PageNote> notes;
  if (const std::string why = shortfall(scene, report); !why.empty())
    notes.push_back({true, why + (report.series.last_frame() == 0 ? "\nNo frame was drawn."
                                                                  : "\nThe frames until then are below.")});
  for (const std::string& warning : warnings) notes.push_back({false, "Warning: " + warning});
  return notes;
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

RunPage describe_run(const Run& run, const FilmReport& report, const std::vector<std::string>& warnings,
                     const Progress& progress) {
  const Scene& scene = run.scene;
  RunPage page;
  page.title = scene.file.stem().string();
  page.summary = summary(run);
  page.notes = notes_of(scene, report, warnings);
  for (const render::View view : scene.render.views)
    if (render::is_png(view)) page.views.emplace_back(render::folder(view));
  page.width = scene.render.width;
  page.height = scene.render.height;
  page.fps = scene.render.fps;
  page.series = report.series;
  page.strip_columns = report.strip_columns;
  page.strip_step = scene.strip ? scene.strip->step : 0.0;
  if (scene.spectrum && report.simulated_time >= scene.spectrum->at * (1.0 - 1e-9))
    page.spectrum_time = scene.spectrum->at;
  for (const CacheRecord& cache : report.caches)
    if (cache.format == CacheFormat::glb) show_model(page);
  page.facts = facts_of(run, report, progress);
  page.command = run.command;
  page.scene = scene.effective;
  return page;
}

}  // namespace billow::cli
