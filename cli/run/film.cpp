// The film's three stages and the queues between them.
#include "cli/run/film.h"

#include <unistd.h>

#include <cmath>
#include <ctime>
#include <exception>
#include <fstream>
#include <functional>
#include <mutex>
#include <thread>

#include "base/error.h"
#include "cli/run/channel.h"
#include "cli/run/frame_recorder.h"
#include "cli/run/incident_text.h"
#include "cli/run/interrupt.h"
#include "cli/run/recorder.h"
#include "cli/run/schedule.h"
#include "render/image/picture.h"

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

struct FinishedImage {
  std::filesystem::path file;
  render::Picture picture;
};

// What the state adds to what a run must be prepared for.
void take_into(render::RunBounds& bounds, const Run& run, const sim::State& state) {
  const Eigen::RowVector3d mean_square = state.velocity.colwise().squaredNorm() / state.velocity.rows();
  bounds.velocity_scale = std::max(bounds.velocity_scale, 2.0 * std::sqrt(mean_square.maxCoeff()));
  bounds.box.extend(run.drawn.box(state));
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
  Film(const Run& run, const render::RunBounds& bounds, const FrameRange& range, const OutputFolder& folder,
       int threads, Progress& progress)
      : run_(run),
        bounds_(bounds),
        folder_(folder),
        threads_(threads),
        progress_(progress),
        setting_{run, folder, range, run.scene.render.velocity_range.value_or(bounds.velocity_scale)},
        images_(static_cast<std::size_t>(2 * threads)),
        error_([this] { snapshots_.abort(), images_.abort(); }),
        report_{.frames = FrameLog(folder.file(RunFile::record))} {}

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
    FrameRecorder frames(setting_, snapshots_);
    std::vector<std::unique_ptr<Recorder>> recorders = make_recorders(setting_, report_);
    Moments moments(all_schedules(run_.scene, setting_.range.last));
    const auto watched = run_.simulation.make_run(run_.choice, [&] { return moments.take(); });
    try {
      record(*watched, frames, recorders);
    } catch (const DivergenceError& error) {
      report_.divergence = error.what();
    }
    const sim::Solver& solver = watched->solver();
    report_.steps = watched->steps();
    report_.simulated_time = watched->time();
    report_.solves = solver.solve_counts();
    report_.incidents = watched->incidents();
    report_.largest_strain = solver.largest_strain();
    frames.finish();
    for (const auto& recorder : recorders) recorder->finish();
  }

  // From one moment that some recorder wants to the next.
  void record(sim::WatchedRun& watched, FrameRecorder& frames,
              const std::vector<std::unique_ptr<Recorder>>& recorders) {
    std::vector<Recorder*> all = {&frames};
    for (const auto& recorder : recorders) all.push_back(recorder.get());
    do {
      if ((report_.interrupted_by = interrupted_by()) != 0) return;
      const Stopwatch watch(report_.simulate);
      const auto sample = watched.next();
      if (!sample) return;
      for (Recorder* recorder : all)
        if (recorder->wants() <= sample->time + Schedule::together) recorder->add(sample->time, sample->state);
    } while (frames.hand_over());
  }

  bool wanted(render::View view, long frame) const { return !folder_.keeps(view, frame); }

  void draw() {
    render::MeshRenderer renderer(run_.scene.render, run_.drawn.bodies(), bounds_, threads_);
    report_.gl = renderer.description();
    report_.velocity_range = renderer.velocity_range();
    progress_.begin("render", setting_.range.last - setting_.range.first + 1);
    while (const auto snapshot = snapshots_.pop()) {
      for (const render::View view : run_.scene.render.views) {
        if (!wanted(view, snapshot->frame)) {
          ++report_.images_kept;
          continue;
        }
        FinishedImage finished{folder_.frame(view, snapshot->frame), {}};
        {
          const Stopwatch watch(report_.draw);
          finished.picture = renderer.draw(view, snapshot->bodies, snapshot->camera_velocity);
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
      render::write_picture(finished->file, finished->picture);
      ++written;
    }
  }

  const Run& run_;
  const render::RunBounds& bounds_;
  const OutputFolder& folder_;
  int threads_;
  Progress& progress_;
  RecorderSetting setting_;
  Channel<Snapshot> snapshots_{4};
  Channel<FinishedImage> images_;
  FirstError error_;
  FilmReport report_;
};

}  // namespace

Survey survey(const Run& run, Progress& progress) {
  Survey result;
  result.bounds.velocity_scale = 0.0;
  const Stopwatch watch(result.cost, CLOCK_PROCESS_CPUTIME_ID);
  const long frames = frame_count(run.scene);
  Moments moments(all_schedules(run.scene, frames));
  const auto watched = run.simulation.make_run(run.choice, [&] { return moments.take(); });
  std::size_t incidents = 0;
  progress.begin("survey", frames);
  try {
    Schedule shown = frame_schedule(run.scene, frames);
    while (interrupted_by() == 0) {
      const auto sample = watched->next();
      for (; incidents < watched->incidents().size(); ++incidents)
        progress.say(incident_text(watched->incidents()[incidents], run.choice.step));
      if (!sample) break;
      take_into(result.bounds, run, sample->state);
      if (shown.take(sample->time)) progress.update(shown.taken(), sample->time);
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

FilmReport make_film(const Run& run, const render::RunBounds& bounds, const FrameRange& range,
                     const OutputFolder& folder, int threads, Progress& progress) {
  return Film(run, bounds, range, folder, threads, progress).run();
}

}  // namespace billow::cli
