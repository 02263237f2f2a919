// State -> energy, momenta and stretch.
#include "cli/run/motion_recorder.h"

#include "cli/run/film.h"
#include "sim/body/momenta.h"
#include "sim/body/stretch.h"

namespace billow::cli {

namespace {

FrameRecord record_of(const Simulation& simulation, long frame, const sim::State& state) {
  const sim::Structure& structure = simulation.structure();
  return {frame,
          state.time,
          sim::kinetic_energy(structure, state),
          simulation.forces().potential_energy(state),
          sim::linear_momentum(structure, state),
          sim::angular_momentum(structure, state),
          sim::stretch_of(structure, state)};
}

}  // namespace

MotionRecorder::MotionRecorder(const RecorderSetting& setting, FilmReport& report)
    : simulation_(setting.run.simulation),
      range_(setting.range),
      frames_(frame_schedule(setting.run.scene, setting.range.last)),
      report_(report) {}

void MotionRecorder::add(double time, const sim::State& state) {
  if (!frames_.take(time) || frames_.taken() < range_.first) return;
  const FrameRecord record = record_of(simulation_, frames_.taken(), state);
  report_.frames.add(record);
  report_.series.add(record);
}

}  // namespace billow::cli
