// The film's three stages and the queues between them.
#include "cli/film.h"

#include <unistd.h>

#include <cmath>
#include <ctime>
#include <exception>
#include <fstream>
#include <functional>
#include <mutex>
#include <thread>

#include "cli/channel.h"
#include "cli/interrupt.h"
#include "cli/spectrum_recorder.h"
#include "cli/strip_rows.h"
#include "render/png.h"
#include "render/velocity_strip.h"
#include "sim/error.h"

namespace billow::cli {

namespace {

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Adds the time until it goes out of scope to `cost`: the wall's, and the thread's or the process's processor time.
class Stopwatch {
 public:
  explicit Stopwatch(StageCost& cost, clockid_t cpu_clock = CLOCK_THREAD_CPUTIME_ID)
      : cost_(cost),
        cpu_clock_(cpu_clock),
        wall_begin_(seconds_of(CLOCK_MONOTONIC)),
        cpu_begin_(seconds_of(cpu_clock)) {}
  ~Stopwatch() {
    cost_.wall += seconds_of(CLOCK_MONOTONIC) - wall_begin_;
    cost_.cpu += seconds_of(cpu_clock_) - cpu_begin_;
  }
  Stopwatch(const Stopwatch&) = delete;

 private:
  StageCost& cost_;
  clockid_t cpu_clock_;
  double wall_begin_, cpu_begin_;
};

/// The sample times of a run in order: frames, strip columns, samples of the spectrum, or several at once.
class Timeline {
 public:
  struct Sample {
    double time = 0.0;  // [s]
    std::optional<long> frame, column;
    bool spectrum = false, image = false;  // a sample of the spectrum's mean; the velocity image
  };

  /// Ends after frame `last_frame` and before the columns of the frame after it.
  Timeline(const Scene& scene, long last_frame)
      : fps_(scene.render.fps),
        last_frame_(last_frame),
        end_(std::min(scene.duration, static_cast<double>(last_frame) / scene.render.fps)) {
    if (scene.strip) column_step_ = scene.strip->step;
    if (!scene.spectrum) return;
    spectrum_step_ = scene.spectrum->step;
    image_time_ = scene.spectrum->at;
  }

  std::optional<Sample> next() {
    const double frame_time = next_frame_ <= last_frame_ ? static_cast<double>(next_frame_ - 1) / fps_ : INFINITY;
    const double column_time = before_end(next_column_, column_step_);
    const double spectrum_time = before_end(next_spectrum_, spectrum_step_);
    const double image_time = image_time_ <= end_ * (1.0 + 1e-12) ? image_time_ : INFINITY;
    const double time = std::min({frame_time, column_time, spectrum_time, image_time});
    if (!std::isfinite(time)) return std::nullopt;
    Sample sample{time, {}, {}, false, false};
    const double together = time + 1e-9;
    if (frame_time <= together) sample.frame = next_frame_++;
    if (column_time <= together) sample.column = next_column_++;
    if (spectrum_time <= together) sample.spectrum = true, ++next_spectrum_;
    if (image_time <= together) sample.image = true, image_time_ = INFINITY;
    return sample;
  }

 private:
  // Nothing is sampled every infinite time, not even at 0.
  double before_end(long number, double step) const {
    const double time = std::isfinite(step) ? static_cast<double>(number) * step : INFINITY;
    return time < end_ * (1.0 - 1e-12) ? time : INFINITY;
  }

  double fps_;
  long last_frame_;
  double end_;
  double column_step_ = INFINITY, spectrum_step_ = INFINITY, image_time_ = INFINITY;
  long next_frame_ = 1, next_column_ = 0, next_spectrum_ = 0;
};

/// Keeps the first error of several threads and tells everyone to stop.
class FirstError {
 public:
  explicit FirstError(std::function<void()> stop) : stop_(std::move(stop)) {}

  template <class Work>
  void guard(const Work& work) {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      stop_();
    }
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::function<void()> stop_;
  std::mutex mutex_;
  std::exception_ptr error_;
};

struct Snapshot {
  long frame = 0;
  double time = 0.0;
  std::vector<sim::SurfaceState> bodies;
};

struct FinishedImage {
  std::filesystem::path file;
  render::Image image;
};

FrameRecord record_of(const Simulation& simulation, long frame, const sim::State& state) {
  const sim::Structure& structure = simulation.structure();
  return {frame,
          state.time,
          sim::kinetic_energy(structure, state),
          simulation.forces().potential_energy(state),
          sim::linear_momentum(structure, state),
          sim::angular_momentum(structure, state)};
}

// By the first `bodies` of the surfaces: what drifts in the water around them does not count.
void extend(Eigen::AlignedBox3d& box, const std::vector<sim::SurfaceState>& surfaces, std::size_t bodies) {
  for (std::size_t b = 0; b < bodies; ++b) {
    box.extend(surfaces[b].position.colwise().minCoeff().transpose().cast<double>());
    box.extend(surfaces[b].position.colwise().maxCoeff().transpose().cast<double>());
  }
}

// What the process holds in memory [KiB]; 0 where the system does not say.
long resident_memory() {
  std::ifstream file("/proc/self/statm");
  long size = 0, resident = 0;
  file >> size >> resident;
  return file ? resident * (sysconf(_SC_PAGESIZE) / 1024) : 0;
}

/// One run of make_film.
class Film {
 public:
  Film(const Scene& scene, const Simulation& simulation, const StepChoice& choice, const render::RunBounds& bounds,
       const FrameRange& range, const OutputFolder& folder, int threads, Progress& progress)
      : scene_(scene),
        simulation_(simulation),
        choice_(choice),
        bounds_(bounds),
        range_(range),
        folder_(folder),
        threads_(threads),
        progress_(progress),
        strip_rows_(scene, simulation.structure()),
        images_(static_cast<std::size_t>(2 * threads)),
        error_([this] { snapshots_.abort(), images_.abort(); }),
        report_{.frames = FrameLog(folder.record())} {}

  FilmReport run() {
    {
      const Stopwatch watch(report_.total, CLOCK_PROCESS_CPUTIME_ID);
      std::vector<std::thread> encoders;
      std::vector<StageCost> encode_cost(threads_);
      std::vector<long> written(threads_, 0);
      std::thread simulator([this] { error_.guard([this] { simulate(); }), snapshots_.close(); });
      for (int t = 0; t < threads_; ++t)
        encoders.emplace_back([&, t] { error_.guard([&] { encode(encode_cost[t], written[t]); }); });
      error_.guard([this] { draw(); });
      images_.close();
      simulator.join();
      for (std::thread& encoder : encoders) encoder.join();
      for (const StageCost& cost : encode_cost) report_.encode.wall += cost.wall, report_.encode.cpu += cost.cpu;
      for (const long images : written) report_.images_written += images;
    }
    error_.rethrow();
    return std::move(report_);
  }

 private:
  void simulate() {
    std::optional<render::VelocityStrip> strip;
    if (scene_.strip)
      strip.emplace(folder_.strip(), strip_rows_.order(),
                    scene_.render.velocity_range.value_or(bounds_.velocity_scale));
    std::optional<SpectrumRecorder> spectrum;
    if (scene_.spectrum) spectrum.emplace(scene_, simulation_);
    const auto solver = simulation_.make_solver(choice_);
    try {
      run_timeline(*solver, strip ? &*strip : nullptr, spectrum ? &*spectrum : nullptr);
    } catch (const DivergenceError& error) {
      report_.divergence = error.what();
    }
    report_.steps = solver->steps();
    report_.simulated_time = solver->state().time;
    report_.solves = solver->solve_counts();
    snapshots_.close();
    if (spectrum) spectrum->finish(folder_, scene_.render.velocity_range.value_or(bounds_.velocity_scale));
    if (!strip) return;
    report_.strip_columns = strip->columns();
    if (report_.strip_columns > 0) strip->finish();
  }

  void run_timeline(sim::Solver& solver, render::VelocityStrip* strip, SpectrumRecorder* spectrum) {
    Timeline timeline(scene_, range_.last);
    while (const auto sample = timeline.next()) {
      if ((report_.interrupted_by = interrupted_by()) != 0) return;
      std::optional<Snapshot> snapshot;
      {
        const Stopwatch watch(report_.simulate);
        const sim::State state = solver.sample(sample->time);
        if (sample->column) strip->add_column(strip_rows_.of(state.velocity));
        if (sample->spectrum) spectrum->add(state);
        if (sample->image) spectrum->show(state);
        if (sample->frame && *sample->frame >= range_.first) {
          const FrameRecord record = record_of(simulation_, *sample->frame, state);
          report_.frames.add(record);
          report_.series.add(record);
          snapshot = {*sample->frame, sample->time, simulation_.surfaces(state)};
        }
      }
      if (snapshot && !snapshots_.push(std::move(*snapshot))) return;
    }
  }

  bool wanted(render::View view, long frame) const { return !folder_.keeps(view, frame); }

  void draw() {
    render::MeshRenderer renderer(scene_.render, simulation_.drawn_bodies(), bounds_, threads_);
    report_.gl = renderer.description();
    report_.velocity_range = renderer.velocity_range();
    progress_.begin("render", range_.last - range_.first + 1);
    while (const auto snapshot = snapshots_.pop()) {
      for (const render::View view : scene_.render.views) {
        if (!wanted(view, snapshot->frame)) {
          ++report_.images_kept;
          continue;
        }
        FinishedImage finished{folder_.frame(view, snapshot->frame), {}};
        {
          const Stopwatch watch(report_.draw);
          finished.image = renderer.draw(view, snapshot->bodies);
        }
        if (!images_.push(std::move(finished))) return;
      }
      progress_.update(++report_.frames_drawn, snapshot->time);
      if (report_.frames_drawn == settled_frames) report_.memory.settled = resident_memory();
    }
    progress_.end();
    report_.memory.end = resident_memory();
  }

  void encode(StageCost& cost, long& written) {
    while (const auto finished = images_.pop()) {
      const Stopwatch watch(cost);
      render::write_png(finished->file, finished->image);
      ++written;
    }
  }

  const Scene& scene_;
  const Simulation& simulation_;
  const StepChoice& choice_;
  const render::RunBounds& bounds_;
  FrameRange range_;
  const OutputFolder& folder_;
  int threads_;
  Progress& progress_;
  StripRows strip_rows_;
  Channel<Snapshot> snapshots_{4};
  Channel<FinishedImage> images_;
  FirstError error_;
  FilmReport report_;
};

}  // namespace

long frame_count(const Scene& scene) {
  return std::max(1L, static_cast<long>(std::ceil(scene.duration * scene.render.fps - 1e-9)));
}

Survey survey(const Scene& scene, const Simulation& simulation, const StepChoice& choice, Progress& progress) {
  Survey result;
  result.bounds.velocity_scale = 0.0;
  const Stopwatch watch(result.cost, CLOCK_PROCESS_CPUTIME_ID);
  const auto solver = simulation.make_solver(choice);
  const long frames = frame_count(scene);
  Timeline timeline(scene, frames);
  progress.begin("survey", frames);
  try {
    while (const auto sample = timeline.next()) {
      if (interrupted_by() != 0) break;
      const sim::State state = solver->sample(sample->time);
      const Eigen::RowVector3d mean_square = state.velocity.colwise().squaredNorm() / state.velocity.rows();
      result.bounds.velocity_scale = std::max(result.bounds.velocity_scale, 2.0 * std::sqrt(mean_square.maxCoeff()));
      extend(result.bounds.box, simulation.surfaces(state), scene.bodies.size());
      if (sample->frame) progress.update(*sample->frame, sample->time);
    }
  } catch (const DivergenceError&) {
    // The film meets the same step and reports it, after writing the frames before it.
  }
  progress.end();
  if (result.bounds.velocity_scale == 0.0) result.bounds.velocity_scale = 1.0;
  return result;
}

double best_wall_seconds(const Survey& survey, const FilmReport& report, int cores) {
  const double packed = (survey.cost.cpu + report.total.cpu) / cores;
  return std::max(packed, std::min(survey.cost.wall, survey.cost.cpu) + std::max(report.simulate.cpu, report.draw.cpu));
}

FilmReport make_film(const Scene& scene, const Simulation& simulation, const StepChoice& choice,
                     const render::RunBounds& bounds, const FrameRange& range, const OutputFolder& folder, int threads,
                     Progress& progress) {
  return Film(scene, simulation, choice, bounds, range, folder, threads, progress).run();
}

}  // namespace billow::cli
