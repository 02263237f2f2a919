// Samples as plain numbers, one after another.
#include "cli/run/spooled_states.h"

#include <array>

#include "base/error.h"

namespace billow::cli {

namespace {

std::size_t field_bytes(Eigen::Index particles) { return static_cast<std::size_t>(particles) * 3 * sizeof(double); }

using Times = std::array<double, 2>;  // [s] the moment and the state's

}  // namespace

// A full disk is no fault as long as nothing has to lie on it.
void SpooledStates::add(const sim::WatchedRun::Sample& sample) {
  particles_ = sample.state.position.rows();
  const std::size_t more = sizeof(Times) + 2 * field_bytes(particles_);
  full_ = full_ || bytes_ + more > most_bytes;
  if (full_) return;
  const Times times{sample.time, sample.state.time};
  try {
    spool_.append(times.data(), sizeof times);
    spool_.append(sample.state.position.data(), field_bytes(particles_));
    spool_.append(sample.state.velocity.data(), field_bytes(particles_));
  } catch (const OutputError&) {
    full_ = true;
    return;
  }
  bytes_ += more;
}

void SpooledStates::close(RunFacts facts, std::optional<std::string> divergence) {
  facts_ = std::move(facts);
  divergence_ = std::move(divergence);
}

std::optional<sim::WatchedRun::Sample> SpooledStates::next() {
  if (read_ == bytes_) {
    if (divergence_) throw DivergenceError(*divergence_);
    return std::nullopt;
  }
  Times times;
  spool_.read(times.data(), sizeof times, read_);
  read_ += sizeof times;
  sim::WatchedRun::Sample sample{times[0],
                                 {Eigen::MatrixX3d(particles_, 3), Eigen::MatrixX3d(particles_, 3), times[1]}};
  for (Eigen::MatrixX3d* field : {&sample.state.position, &sample.state.velocity}) {
    spool_.read(field->data(), field_bytes(particles_), read_);
    read_ += field_bytes(particles_);
  }
  return sample;
}

}  // namespace billow::cli
