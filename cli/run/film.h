// The film: simulation, drawing and PNG encoding, side by side.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/run/frame_log.h"
#include "cli/run/output_folder.h"
#include "cli/run/progress.h"
#include "cli/run/run.h"
#include "cli/run/run_series.h"
#include "cli/run/spooled_states.h"
#include "cli/run/state_source.h"
#include "render/gl/backend.h"
#include "sim/step/schemes.h"

namespace billow::cli {

/// What one stage of a run took.
struct StageCost {
  double wall = 0.0;  // [s] at work, waiting for its queues left out; of all its threads together
  double cpu = 0.0;   // [s] of the processor, by its own threads
};

/// Frames after which a run has all the memory that it needs, however long it is.
constexpr long settled_frames = 100;

/// What the process held in memory [KiB] after settled_frames (0 in a shorter film) and after the last frame.
struct ResidentMemory {
  long settled = 0, end = 0;
};

/// What a run needs to know of itself before its first frame.
struct Survey {
  render::RunBounds bounds;
  StageCost cost;
};

/// An array that was written for NumPy, and what its axes are.
struct WrittenArray {
  std::string file, type;  // relative to the run's folder; "<f4"
  std::vector<long> shape;
  std::vector<std::string> axes;
  std::string unit;
};

/// A geometry cache that was written.
struct CacheRecord {
  CacheFormat format;
  std::string name;            // of the body or collider; empty: all of them
  std::filesystem::path file;  // that a program opens, relative to the run's folder: of a sequence its first
  long first_frame = 1, frames = 0;
  std::optional<int> vertices = {};
};

struct FilmReport {
  FrameLog frames;
  RunSeries series = {};  // of the same frames
  long frames_drawn = 0, images_written = 0, images_kept = 0;
  int strip_columns = 0;
  std::vector<WrittenArray> arrays = {};
  RunFacts facts = {};
  double simulated_time = 0.0;        // [s] until the end, or where it was interrupted
  double velocity_range = 0.0;        // [m/s]
  std::string backend = {}, gl = {};  // what drew: as --backend has it, and as GL says; empty where nothing was drawn
  ResidentMemory memory = {};
  StageCost simulate = {}, draw = {}, encode = {};
  StageCost total = {};    // `cpu` of the whole process: the renderer's own threads, which `draw` cannot see, included
  int interrupted_by = 0;  // the signal that ended the run early, or 0
  std::optional<std::string> divergence = {};  // the message, when the run diverged
  std::vector<CacheRecord> caches = {};
  std::optional<double> filter_response = {};  // of a force filter to the motion's velocities
};

/// Goes through all states of `states` without drawing, to find the box that the frames take up and the scale of their
/// velocities (95 % of their components are within it): the camera, the shadow and the velocity colours are then the
/// same for every frame, whichever frames are drawn. `spool`, where there is one, gets all states. A divergence ends
/// the survey early without an error; the film then meets it too.
Survey survey(const Run& run, StateSource& states, SpooledStates* spool, Progress& progress);

/// The least time [s] in which `cores` could have done the run's work: all of it, perfectly packed, or the chain that
/// no packing can shorten: the survey, then the longer of the two stages that take one frame after another.
double best_wall_seconds(const Survey& survey, const FilmReport& report, int cores);

/// What a film is made of.
struct FilmPlan {
  FrameRange drawn;                 // frames that are drawn
  FrameRange recorded;              // frames that the other outputs are of
  std::vector<render::View> views;  // of each; may be none
  bool only_frames = false;         // nothing that takes other moments than the frames'
  bool only_pictures = false;       // nothing else at all: `recorded` is of no account
  render::Backend backend = {};     // that draws them
};

/// Draws frames into `folder`, and writes what else the scene asks for. States, drawing and `threads` encoders overlap;
/// queues between them are bounded. A divergence or a signal ends the film after the frames before it are written; any
/// other error is thrown.
FilmReport make_film(const Run& run, StateSource& states, const render::RunBounds& bounds, const FilmPlan& plan,
                     const OutputFolder& folder, int threads, Progress& progress);

}  // namespace billow::cli
