// A function for each command.
#include "cli/command/command_options.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/command/build_facts.h"
#include "cli/text/text_file.h"
#include "cli/text/version.h"

namespace billow::cli {

namespace {

// What running a scene takes, drawn or not.
void add_run_options(CLI::App& c, Request& r) {
  add_scene_options(c, r.render.scene, r, "Scene file (YAML)");
  c.add_option("-o,--output", r.render.output, "Folder to write to (default: out/ and the scene's name)")
      ->check(refuse_standard_output)
      ->type_name("DIR");
  c.add_option("--cache", r.caches, "Also write geometry caches: pc2, mdd, obj, ply, vtp, glb (comma-separated)")
      ->type_name("FORMATS");
  CLI::Option* overwrite = c.add_flag("--overwrite", r.overwrite, "Replace an earlier run in the folder");
  c.add_flag("--resume", r.resume,
             "Finish or extend an earlier run of the same scene in the folder; what is damaged is made again")
      ->excludes(overwrite);
  c.add_option("--threads", r.render.threads, "Threads for simulating, drawing and encoding (default: one per core)")
      ->check(CLI::Range(1, 256))
      ->type_name("N");
  c.add_flag("--durable", r.render.durable,
             "Wait for the disk before a file gets its name: power cuts leave whole files");
  add_progress(c, &r.render.progress);
  c.final_callback([&r, &c] {
    require_scene_file(r.render.scene);
    for (const std::string& text : r.overrides) r.render.overrides.push_back(parse_override(text));
    if (!r.caches.empty()) r.render.overrides.push_back({"caches", "[" + r.caches + "]"});
    if (is_given(c, "--frames")) r.render.frames = parse_frame_list(r.frames);
    if (!r.render.simulate_only) {
      r.render.backend = chosen_backend(c, r);
      r.spread.backend = backend_handed_on(c, r.render.backend);
    }
    r.render.existing = r.overwrite ? Existing::overwrite : r.resume ? Existing::resume : Existing::refuse;
    r.spread.untrusted = r.untrusted;
    check_spread(r);
    set_command(r, r.render.scene,
                [&r] { return r.spread.any() ? spread_frames_command(r.render, r.spread) : render_command(r.render); });
  });
}

void add_render(CLI::App& app, Request& r) {
  CLI::App& c = *app.add_subcommand("render", "Simulate a scene and write its frames, strip, record and page");
  add_run_options(c, r);
  add_backend(c, r);
  CLI::Option* resume = c.get_option("--resume");
  c.add_option("--frames", r.frames, "Draw only these frames, 1-based: 7, 1-250, 300-, every fifth 1-250:5, or a list")
      ->type_name("LIST")
      ->excludes(resume);
  CLI::Option* from =
      c.add_option("--from", r.render.from, "Draw the states that 'billow simulate' wrote to this folder")
          ->type_name("DIR")
          ->excludes(resume);
  CLI::Option* frames_only =
      c.add_flag("--frames-only", r.render.frames_only, "With --from: leave the record and the page to --collect")
          ->needs(from);
  CLI::Option* collect =
      c.add_flag("--collect", r.render.collect, "With --from: draw nothing; write record and page of what is drawn")
          ->needs(from)
          ->excludes(frames_only);
  const std::vector<CLI::Option*> spread =
      add_spread_options(c, r, "frames", "as many as make two tasks for each of --array-limit");
  for (CLI::Option* option : {frames_only, collect, c.get_option("--overwrite")})
    for (CLI::Option* elsewhere : spread) option->excludes(elsewhere);
  collect->excludes("--overwrite");
  c.add_flag("--video", r.spread.video, "With --slurm: make a film of the frames in the end")->needs(spread.back());
}

void add_simulate(CLI::App& app, Request& r) {
  CLI::App& c = *app.add_subcommand(
      "simulate", "Simulate a scene and keep its states, exact; 'render --from' draws any frames of them");
  add_run_options(c, r);
  c.parse_complete_callback([&r] { r.render.simulate_only = true; });
}

void add_scene_command(CLI::App& app, Request& r, const std::string& name, const std::string& help, bool with_json,
                       int (*command)(const SceneOptions&)) {
  CLI::App& c = *app.add_subcommand(name, help);
  add_scene_options(c, r.scene.scene, r);
  if (with_json) c.add_flag("--json", r.scene.json, "Print JSON");
  add_progress(c, &r.scene.progress);
  c.final_callback([&r, command] {
    for (const std::string& text : r.overrides) r.scene.overrides.push_back(parse_override(text));
    set_command(r, r.scene.scene, [&r, command] { return command(r.scene); });
  });
}

void add_mesh(CLI::App& app, Request& r) {
  CLI::App& c =
      *app.add_subcommand("mesh", "Look at a mesh file: counts, size, pieces, borders, what it has and lacks");
  add_named_file(c, "FILE", r.mesh.mesh, "Mesh file (.obj, .off, .stl, .ply, .gltf or .glb)", r);
  c.add_flag("--json", r.mesh.json, "Print JSON");
  add_progress(c);
  c.final_callback([&r] { set_command(r, r.mesh.mesh, [&r] { return mesh_command(r.mesh); }); });
}

void add_stability(CLI::App& app, Request& r) {
  CLI::App& c =
      *app.add_subcommand("stability", "Print k0 and every method's step limits, with and without the filter");
  add_scene_options(c, r.stability.scene.scene, r);
  c.add_flag("--json", r.stability.scene.json, "Print JSON");
  c.add_flag("--measured", r.stability.measured, "Also measure the limits on whole non-linear runs (slow)");
  c.add_option("--at", r.stability.time, "Linearise the state that the scene reaches at this time (default: at rest)")
      ->check(CLI::Range(0.0, 1e6))
      ->type_name("SECONDS");
  add_progress(c, &r.stability.scene.progress);
  c.final_callback([&r] {
    if (!std::isfinite(r.stability.time)) throw CLI::ValidationError("--at", "needs a finite time");
    for (const std::string& text : r.overrides) r.stability.scene.overrides.push_back(parse_override(text));
    set_command(r, r.stability.scene.scene, [&r] { return stability_command(r.stability); });
  });
}

void add_filter(CLI::App& app, Request& r) {
  CLI::App& c = *app.add_subcommand(
      "filter", "Print a scene's levels, and plot what its filter and others keep of waves of every frequency");
  add_scene_options(c, r.filter.scene.scene, r);
  c.add_flag("--json", r.filter.scene.json, "Print JSON and write no plot");
  c.add_option("--body", r.filter.body, "Whose waves (default: the scene's first body)")->type_name("NAME");
  c.add_option("-o,--output", r.filter.output, "Folder to write to (default: out/ and the scene's name with -filter)")
      ->check(refuse_standard_output)
      ->type_name("DIR");
  add_progress(c, &r.filter.scene.progress);
  c.final_callback([&r] {
    if (!r.filter.scene.json && r.filter.output.empty()) require_scene_file(r.filter.scene.scene);
    for (const std::string& text : r.overrides) r.filter.scene.overrides.push_back(parse_override(text));
    set_command(r, r.filter.scene.scene, [&r] { return filter_command(r.filter); });
  });
}

// "3" of 255, or "0.1%"; nothing leaves `of_255` as it is.
void set_share_of_white(const std::string& option, const std::string& text, double& of_255) {
  if (!text.empty() && !read_share_of_white(text, of_255))
    throw CLI::ValidationError(
        option, fmt::format("'{}' is neither a number from 0 to 255 nor a share of white like 0.1%", text));
}

void set_tolerance(Request& r) {
  ImageTolerance& tolerance = r.compare.tolerance;
  set_share_of_white("--channel", r.channel, tolerance.what.threshold);
  set_share_of_white("--worst", r.worst, tolerance.allowed.worst);
  if (!r.pixels.empty() && !read_pixels(r.pixels, tolerance.allowed))
    throw CLI::ValidationError(
        "--pixels", fmt::format("'{}' is neither a number of pixels like 250 nor a share like 0.5%", r.pixels));
  for (const std::string& text : r.metrics) tolerance.allowed.metrics.push_back(parse_metric(text));
  for (const render::MetricLimit& limit : tolerance.allowed.metrics)
    tolerance.what.flip = tolerance.what.flip || limit.metric == render::Metric::flip;
}

void add_compare(CLI::App& app, Request& r) {
  CLI::App& c = *app.add_subcommand("compare", "Compare two images (PNG, OpenEXR) or two folders of images");
  c.add_option("A", r.compare.a, "Image or folder")->required();
  c.add_option("B", r.compare.b, "Image or folder")->required();
  c.add_option("--diff", r.compare.difference,
               "Write the difference image, times 8; of two folders those of all that differ")
      ->check(refuse_standard_output)
      ->type_name("FILE|DIR");
  c.add_option("--channel", r.channel,
               "A pixel differs when a channel does by more: of 255, or of white, which is 1 in EXR (default: 3)")
      ->type_name("N|N%");
  c.add_option("--pixels", r.pixels, "So many pixels, or so much of all, may differ (default: 1%)")->type_name("N|N%");
  c.add_option("--worst", r.worst, "No channel may differ by more (default: 16)")->type_name("N|N%");
  c.add_option("--edge", r.compare.tolerance.what.edge,
               "Differences that edges up to N pixels aside explain are none, 0 to 4 (default: 0)")
      ->check(CLI::Range(0, render::largest_edge))
      ->type_name("N");
  c.add_option("--metric", r.metrics,
               "Judge by max, rmse, psnr, ssim or flip instead: at most LIMIT, for psnr and ssim at least (repeatable)")
      ->type_name("METRIC=LIMIT")
      ->allow_extra_args(false)
      ->excludes("--pixels")
      ->excludes("--worst");
  c.add_option("--mask", r.compare.tolerance.mask, "PNG of the images' size: what is white in it counts")
      ->type_name("FILE");
  c.add_flag("--ignore-alpha", r.compare.tolerance.what.ignore_alpha, "Compare colours only");
  c.add_option("--report", r.compare.report, "Write a page to look at what differs, worst first")
      ->check(refuse_standard_output)
      ->type_name("DIR");
  c.add_option("--junit", r.compare.junit, "Write the pairs as test cases of JUnit's XML")
      ->check(refuse_standard_output)
      ->type_name("FILE");
  c.add_flag("--accept", r.compare.accept, "Copy from B to A what differs or is new (not where CI is set)");
  c.add_option("--accept-only", r.compare.accept_only, "Copy this image alone (repeatable)")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->excludes("--accept");
  c.add_flag("--json", r.compare.json, "Print JSON");
  add_progress(c);
  c.final_callback([&r] {
    set_tolerance(r);
    r.command = [&r] { return compare_command(r.compare); };
  });
}

void add_golden(CLI::App& app, Request& r) {
  CLI::App& c = *app.add_subcommand(
      "golden",
      "Render the scenes of a file of tests and compare their pictures with baselines; exit 3 when they differ");
  add_named_file(c, "TESTS", r.golden.tests, "File of tests (YAML)", r);
  c.add_option("-o,--output", r.golden.output, "Folder to write to (default: out/ and the name of TESTS)")
      ->check(refuse_standard_output)
      ->type_name("DIR");
  CLI::Option* only =
      c.add_option("--only", r.golden.only, "Tests or pictures of these names alone: drape, 'drape/vel*'")
          ->type_name("NAME");
  CLI::Option* update = c.add_option("--update", r.golden.update,
                                     "These alone, and accept what differs or is new of them (not where CI is set)")
                            ->type_name("NAME")
                            ->excludes(only);
  c.add_flag("--list", r.golden.list, "Print the names of the tests and do nothing")->excludes(update);
  c.add_flag("--allow-commands", r.golden.may_run_programs, "Run the commands that TESTS names")
      ->excludes(c.get_option("--untrusted"));
  c.add_option("--junit", r.golden.junit, "Write the pictures as test cases of JUnit's XML")
      ->check(refuse_standard_output)
      ->type_name("FILE");
  c.add_flag("--json", r.golden.json, "Print JSON");
  add_progress(c);
  c.add_option("--jobs", r.golden.jobs, "Tests at a time (default: one per core)")
      ->check(CLI::Range(1, 256))
      ->type_name("N");
  add_backend(c, r);
  c.add_option("--perform", r.golden.perform)->group("");  // how tests are started; no part of the help
  c.final_callback([&r, &c] {
    r.golden.untrusted = r.untrusted;
    r.golden.backend = chosen_backend(c, r);
    set_command(r, r.golden.tests, [&r] { return golden_command(r.golden); });
  });
}

void add_study(CLI::App& app, Request& r) {
  CLI::App& c = *app.add_subcommand(
      "study", "Run a scene over axes of variation; make pictures, tables and a page; several may share a folder");
  add_named_file(c, "STUDY", r.study.study, "Study file (YAML)", r);
  c.add_option("-o,--output", r.study.output, "Folder to write to (default: out/ and the study's name)")
      ->check(refuse_standard_output)
      ->type_name("DIR");
  CLI::Option* list = c.add_flag("--list", r.study.list, "Print the runs and whether they are finished");
  CLI::Option* only =
      c.add_option("--only", r.study.only, "Do this run alone")->check(CLI::Range(1, 1000000))->type_name("N");
  CLI::Option* collect = c.add_flag("--collect", r.study.collect, "Assemble the finished runs, without running any");
  CLI::Option* overwrite = c.add_flag("--overwrite", r.study.overwrite, "Run again what is finished");
  // How a study's own processes are started; no part of the help.
  c.add_option("--perform", r.study.perform)->check(CLI::Range(1, 1000000))->group("");
  CLI::Option* some =
      c.add_option("--runs", r.runs, "Do these runs alone, where they are unfinished: 7, 1-12,40-")->type_name("LIST");
  list->excludes(only)->excludes(collect)->excludes(overwrite);
  collect->excludes(only)->excludes(overwrite);
  for (CLI::Option* option : {list, only, collect}) some->excludes(option);
  const std::vector<CLI::Option*> handed_on = add_spread_options(c, r, "runs", "1");
  for (CLI::Option* elsewhere : handed_on)
    for (CLI::Option* option : {list, only, collect, some, overwrite}) elsewhere->excludes(option);
  CLI::Option* jobs =
      c.add_option("--jobs", r.study.jobs, "Runs at a time (default: one per core; one where runs are timed)")
          ->check(CLI::Range(1, 256))
          ->type_name("N");
  for (CLI::Option* elsewhere : handed_on) jobs->excludes(elsewhere);
  add_backend(c, r);
  CLI::Option* threads = c.add_option("--threads", r.study.threads, "Threads of each run (default: one per core)")
                             ->check(CLI::Range(1, 256))
                             ->type_name("N");
  CLI::Option* resume =
      c.add_flag("--resume", r.study.resume,
                 "Runs keep their states while they go on: one that is stopped is gone on with from there");
  for (CLI::Option* option : {jobs, threads, resume}) option->excludes(list)->excludes(collect);
  add_progress(c);
  c.final_callback([&r, &c] {
    check_spread(r);
    r.study.untrusted = r.spread.untrusted = r.untrusted;
    r.study.backend = chosen_backend(c, r);
    r.spread.backend = backend_handed_on(c, r.study.backend);
    r.study.spread = r.spread;
    if (is_given(c, "--runs")) r.study.some = parse_run_list(r.runs);
    set_command(r, r.study.study, [&r] { return study_command(r.study); });
  });
}

// Of what is made of a run's frames.
template <class Options>
void add_folder_options(CLI::App& command, Options& options, const std::string& default_name) {
  command.add_option("DIR", options.folder, "Folder of a run")->required();
  command.add_option("--view", options.views, "View, or several side by side: textured,velocity (default: the first)")
      ->type_name("VIEWS");
  command
      .add_option("-o,--output", options.output,
                  fmt::format("File to write (default: in DIR, the view's name and {})", default_name))
      ->check(refuse_standard_output)
      ->type_name("FILE");
  command.add_flag("--overwrite", options.overwrite, "Replace the file");
}

void add_video(CLI::App& app, Request& r) {
  CLI::App& c = *app.add_subcommand("video", "Make a film of a run's frames: .mp4, .webm, .gif or .apng (by ffmpeg)");
  add_folder_options(c, r.video, ".mp4");
  c.add_option("--fps", r.video.fps, "Frames a second (default: the run's)")
      ->check(CLI::Range(0.01, 1000.0))
      ->type_name("N");
  add_progress(c, &r.video.progress);
  c.final_callback([&r] { r.command = [&r] { return video_command(r.video); }; });
}

void add_sheet(CLI::App& app, Request& r) {
  CLI::App& c = *app.add_subcommand("sheet", "Show frames of a run side by side on one page, with their times");
  add_folder_options(c, r.sheet, "_sheet.png");
  c.add_option("-n,--count", r.sheet.count, "Frames, evenly chosen (default: 12)")
      ->check(CLI::Range(1, 400))
      ->type_name("N");
  c.add_option("--columns", r.sheet.columns, "Frames a row (default: about as many as rows)")
      ->check(CLI::Range(1, 400))
      ->type_name("N");
  add_progress(c);
  c.final_callback([&r] { r.command = [&r] { return sheet_command(r.sheet); }; });
}

// What the build of a package runs; no part of the help.
void add_generate(CLI::App& app, Request& r) {
  CLI::App& c = *app.add_subcommand("generate", "Print the manual page, or how a shell completes this")->group("");
  c.add_option_function<std::string>(
       "KIND", [&r](const std::string& text) { r.generated = parse_word<Generated>("KIND", text); },
       "man, bash, zsh or fish")
      ->required();
  c.final_callback([&app, &r] { r.command = [&app, &r] { return generate_command(r.generated, app); }; });
}

}  // namespace

void add_commands(CLI::App& app, Request& r) {
  // Options are looked at in this order: --version knows by then whether it is to be JSON.
  CLI::Option* json = app.add_flag("--json", r.version_as_json, "With --version: what this build was made of, as JSON");
  json->needs(app.set_version_flag("--version", [&r] {
    return r.version_as_json ? build_facts_json(r.commit) : fmt::format("billow {}", version());
  }));
  app.require_subcommand(1);
  // Its messages quote arguments, line ends and all.
  app.failure_message([](const CLI::App* command, const CLI::Error& error) {
    return CLI::FailureMessage::simple(command,
                                       CLI::Error(error.get_name(), printable(error.what()), error.get_exit_code()));
  });
  app.set_help_all_flag("--help-all", "Help of every command");
  add_render(app, r);
  add_simulate(app, r);
  add_scene_command(app, r, "check", "Validate a scene without simulating it; print it with every default", false,
                    check_command);
  add_mesh(app, r);
  add_scene_command(app, r, "structure", "Print the particles and springs of a scene", true, structure_command);
  add_stability(app, r);
  add_filter(app, r);
  add_study(app, r);
  add_compare(app, r);
  add_golden(app, r);
  add_video(app, r);
  add_sheet(app, r);
  app.add_subcommand("doctor", "Print versions, what can draw here, and what is missing")->final_callback([&r] {
    r.command = doctor_command;
  });
  add_generate(app, r);
}

}  // namespace billow::cli
