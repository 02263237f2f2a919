// What is kept of a run while it runs: frames, energies, strip, spectrum, and whatever is written next.
#pragma once

#include <memory>
#include <vector>

#include "cli/run/output_folder.h"
#include "cli/run/run.h"
#include "render/frame/mesh_renderer.h"

namespace billow::cli {

struct FilmReport;

/// One output of a run. It is asked for the time of the state that it wants next, given that state, and at the end,
/// which may come early, told to finish.
class Recorder {
 public:
  virtual ~Recorder() = default;
  /// [s] of the next state that it wants; infinite when it wants no more.
  virtual double wants() const = 0;
  /// The state at the `time` [s] that it wants, or so near to it that it is the same moment (Schedule::together).
  virtual void add(double time, const sim::State& state) = 0;
  /// Writes what it has gathered. Throws OutputError.
  virtual void finish() = 0;
};

/// What a recorder can know before the first state.
struct RecorderSetting {
  const Run& run;
  const OutputFolder& folder;
  FrameRange range;       // of the frames that are recorded
  double velocity_range;  // [m/s] v_max of all colours
};

/// The recorders of all that the scene asks for besides its pictures, or of that alone which frames say
/// (`only_frames`). What they come to goes into `report`, which must outlive them, as must what `setting` refers to.
std::vector<std::unique_ptr<Recorder>> make_recorders(const RecorderSetting& setting, bool only_frames,
                                                      FilmReport& report);

}  // namespace billow::cli
