// A scene's whole run: frames, strip, record and page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/run/output_folder.h"
#include "cli/run/progress.h"
#include "cli/run/run.h"
#include "render/gl/backend.h"

namespace billow::cli {

struct RenderOptions {
  std::filesystem::path scene;
  std::vector<Override> overrides;
  std::filesystem::path output;   // empty: out/ and the scene's name, or where the states are
  std::vector<FrameSpan> frames;  // empty: all
  std::filesystem::path from;     // a run whose states are drawn; empty: simulate
  bool simulate_only = false;     // keep the states, and draw nothing
  bool frames_only = false;       // of `from`: no record and no page, which somebody will collect
  bool collect = false;           // of `from`: the record and the page of frames that are there, and draw nothing
  bool keep_states = false;       // `resume` shall go on from there, and what it finds drawn counts as drawn by it
  Existing existing = Existing::refuse;
  int threads = 0;               // 0: one per core
  render::Backend backend = {};  // that draws
  bool durable = false;          // files are on the disk before they have their names
  ProgressStyle progress = ProgressStyle::automatic;
  std::string command;  // as it was typed, for run.json
};

/// Where the run's files go.
std::filesystem::path output_of(const RenderOptions& options);
/// What to do with what is there.
Existing existing_of(const RenderOptions& options);
/// Which frames are drawn. Throws InputError when the scene does not have them.
FrameRange range_of(const RenderOptions& options, const Scene& scene);

/// Tries what is to draw, so that what is wrong with it is found before anything is simulated. Throws ResourceError.
void check_backend(const RenderOptions& options);

/// Runs a scene that has been read and whose step has been chosen, as further phases of `progress`; of options.scene
/// only the name is used, .overrides and .progress not at all. Returns 0, 1 where frames to be collected are missing,
/// or 128 + a signal that ended it. Throws DivergenceError once all that came before is written, InputError,
/// OutputError.
int render_scene(const Scene& scene, const Simulation& simulation, const StepChoice& choice,
                 const RenderOptions& options, Progress& progress);

}  // namespace billow::cli
