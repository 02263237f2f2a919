// State -> energy, momenta and stretch.
#include "cli/run/motion_recorder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "base/atomic_file.h"
#include "cli/run/film.h"
#include "sim/body/momenta.h"
#include "sim/body/stretch.h"
#include "sim/contact/touching.h"

namespace billow::cli {

namespace {

long touching_particles(const Simulation& simulation, const sim::State& state) {
  const std::optional<sim::ContactModel>& contact = simulation.phase_at(state.time).contact;
  return contact ? std::lround(sim::touching(*contact, state).sum()) : 0;
}

FrameRecord record_of(const Simulation& simulation, long frame, const sim::State& state) {
  const sim::Structure& structure = simulation.structure();
  return {frame,
          state.time,
          sim::kinetic_energy(structure, state),
          simulation.forces().potential_energy(state),
          sim::linear_momentum(structure, state),
          sim::angular_momentum(structure, state),
          sim::stretch_of(structure, state),
          touching_particles(simulation, state)};
}

}  // namespace

MotionRecorder::MotionRecorder(const RecorderSetting& setting, FilmReport& report)
    : simulation_(setting.run.simulation),
      folder_(setting.folder),
      range_(setting.range),
      frames_(frame_schedule(setting.run.scene, setting.range.last)),
      report_(report) {}

void MotionRecorder::add(double time, const sim::State& state) {
  if (!frames_.take(time) || !range_.contains(frames_.taken())) return;
  const FrameRecord record = record_of(simulation_, frames_.taken(), state);
  report_.frames.add(record);
  report_.series.add(record);
}

// A row a frame; numbers read back to the bit.
void MotionRecorder::finish() {
  AtomicFile output(folder_.file(RunFile::frame_table));
  output.append(
      "frame,time_s,kinetic_energy_J,potential_energy_J,linear_momentum_x_kg_m_s,linear_momentum_y_kg_m_s,"
      "linear_momentum_z_kg_m_s,angular_momentum_x_kg_m2_s,angular_momentum_y_kg_m2_s,angular_momentum_z_kg_m2_s,"
      "largest_stretch,mean_stretch,touching_particles\n");
  for (const FrameRecord& record : report_.frames)
    output.append(fmt::format("{},{},{}\n", record.frame, record.time, fmt::join(measures_of(record), ",")));
  output.commit();
}

}  // namespace billow::cli
