// The film's three stages and the queues between them.
#include "cli/run/film.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <fstream>
#include <functional>
#include <mutex>
#include <thread>

#include "base/error.h"
#include "cli/run/channel.h"
#include "cli/run/component_histogram.h"
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
  bool there() {
    const std::lock_guard lock(mutex_);
    return error_ != nullptr;
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

// What the process holds in memory [KiB]; 0 where the system does not say.
long resident_memory() {
  std::ifstream file("/proc/self/statm");
  long size = 0, resident = 0;
  file >> size >> resident;
  return file ? resident * (sysconf(_SC_PAGESIZE) / 1024) : 0;
}

/// How many finished images are in memory at a time.
struct ImageRoom {
  std::size_t waiting;  // for an encoder
  int encoders;         // with one each
};

// Two wait for each thread as far as a gibibyte holds them, and as many are encoded as four do; one of each always. A
// frame of the data view takes 24 floats a pixel: the largest 6.4 GB.
ImageRoom image_room(const render::Settings& settings, const std::vector<render::View>& views, int threads) {
  constexpr std::size_t gibibyte = std::size_t{1} << 30;
  const bool has_data = std::find(views.begin(), views.end(), render::View::data) != views.end();
  const std::size_t pixel = has_data ? 24 * sizeof(float) : 4;
  const std::size_t image =
      pixel * static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  return {std::clamp<std::size_t>(gibibyte / image, 1, 2 * static_cast<std::size_t>(threads)),
          static_cast<int>(std::clamp<std::size_t>(4 * gibibyte / image, 1, static_cast<std::size_t>(threads)))};
}

/// One run of make_film.
class Film {
 public:
  Film(const Run& run, StateSource& states, const render::RunBounds& bounds, const FilmPlan& plan,
       const OutputFolder& folder, int threads, Progress& progress)
      : run_(run),
        states_(states),
        bounds_(bounds),
        plan_(plan),
        folder_(folder),
        room_(image_room(run.scene.render, plan.views, threads)),
        threads_(threads),
        progress_(progress),
        setting_{run, folder, plan.recorded, run.scene.render.velocity_range.value_or(bounds.velocity_scale)},
        images_(room_.waiting),
        error_([this] { snapshots_.abort(), images_.abort(); }),
        report_{.frames = FrameLog(folder.file(RunFile::record))} {}

  FilmReport run() {
    {
      const Stopwatch watch(report_.total, CLOCK_PROCESS_CPUTIME_ID);
      std::vector<std::thread> encoders;
      std::vector<StageCost> encode_cost(static_cast<std::size_t>(room_.encoders));
      std::vector<long> written(encode_cost.size(), 0);
      std::thread simulator([this] { error_.guard([this] { simulate(); }), snapshots_.close(); });
      for (std::size_t t = 0; t < written.size(); ++t)
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
    FrameRecorder frames(setting_, plan_.drawn, snapshots_);
    std::vector<std::unique_ptr<Recorder>> recorders;
    if (!plan_.only_pictures) recorders = make_recorders(setting_, plan_.only_frames, report_);
    try {
      record(frames, recorders);
    } catch (const DivergenceError& error) {
      report_.divergence = error.what();
    }
    if (error_.there()) return;  // frames cannot be written: what was recorded until now is not of the run
    report_.facts = states_.facts();
    if (!report_.interrupted_by) report_.simulated_time = report_.facts.time;
    frames.finish();
    for (const auto& recorder : recorders) recorder->finish();
  }

  // From one moment that some recorder wants to the next.
  void record(FrameRecorder& frames, const std::vector<std::unique_ptr<Recorder>>& recorders) {
    std::vector<Recorder*> all = {&frames};
    for (const auto& recorder : recorders) all.push_back(recorder.get());
    do {
      if ((report_.interrupted_by = interrupted_by()) != 0) return;
      const Stopwatch watch(report_.simulate);
      const auto sample = states_.next();
      if (!sample) return;
      report_.simulated_time = sample->state.time;
      for (Recorder* recorder : all)
        if (recorder->wants() <= sample->time + Schedule::together) recorder->add(sample->time, sample->state);
    } while (frames.hand_over());
  }

  // Whether the frame is there already, and whole: what a power cut or a copy has spoilt is drawn again, and said.
  bool keeps(render::View view, long frame) {
    if (!folder_.keeps(view, frame)) return false;
    const std::filesystem::path file = folder_.frame(view, frame);
    const auto fault = render::picture_fault(file, run_.scene.render.width, run_.scene.render.height);
    if (fault) progress_.say(fmt::format("warning: {} {}; it is drawn again", file.string(), *fault));
    return !fault;
  }

  void draw() {
    std::optional<render::MeshRenderer> renderer;  // no GL where nothing is drawn
    if (!plan_.views.empty())
      renderer.emplace(run_.drawn.settings(), run_.drawn.bodies(), bounds_from_origin(),
                       render::DrawingOptions{.backend = plan_.backend, .threads = threads_});
    if (renderer) report_.backend = text_of(renderer->backend()), report_.gl = renderer->description();
    report_.velocity_range = setting_.velocity_range;
    progress_.begin(renderer ? "render" : "simulate", plan_.drawn.count());
    while (const auto snapshot = snapshots_.pop()) {
      for (const render::View view : plan_.views)
        if (!draw(*renderer, view, *snapshot)) return;
      progress_.update(++report_.frames_drawn, snapshot->time);
      if (report_.frames_drawn == settled_frames) report_.memory.settled = resident_memory();
    }
    progress_.end();
    report_.memory.end = resident_memory();
  }

  render::RunBounds bounds_from_origin() const {
    render::RunBounds bounds = bounds_;
    bounds.box.translate(-run_.drawn.origin());
    return bounds;
  }

  // False when nobody encodes any more.
  bool draw(render::MeshRenderer& renderer, render::View view, const Snapshot& snapshot) {
    if (keeps(view, snapshot.frame)) return ++report_.images_kept, true;
    FinishedImage finished{folder_.frame(view, snapshot.frame), {}};
    {
      const Stopwatch watch(report_.draw);
      finished.picture = renderer.draw(view, snapshot.bodies, snapshot.camera_velocity, snapshot.time);
    }
    return images_.push(std::move(finished));
  }

  void encode(StageCost& cost, long& written) {
    while (const auto finished = images_.pop()) {
      const Stopwatch watch(cost);
      render::write_picture(finished->file, finished->picture);
      ++written;
    }
  }

  const Run& run_;
  StateSource& states_;
  const render::RunBounds& bounds_;
  const FilmPlan& plan_;
  const OutputFolder& folder_;
  ImageRoom room_;
  int threads_;
  Progress& progress_;
  RecorderSetting setting_;
  Channel<Snapshot> snapshots_{4};
  Channel<FinishedImage> images_;
  FirstError error_;
  FilmReport report_;
};

}  // namespace

namespace {

// Of all velocity components of a run, as many are within the colours: a whipping corner does not grey out all else.
constexpr double shown_share = 0.95;

/// Says what went wrong and was mended as soon as it is known.
class IncidentTeller {
 public:
  IncidentTeller(double step, Progress& progress) : step_(step), progress_(progress) {}
  void tell(const std::vector<sim::Incident>& incidents) {
    for (; told_ < incidents.size(); ++told_) progress_.say(incident_text(incidents[told_], step_));
  }

 private:
  double step_;
  Progress& progress_;
  std::size_t told_ = 0;
};

}  // namespace

Survey survey(const Run& run, StateSource& states, SpooledStates* spool, Progress& progress) {
  Survey result;
  ComponentHistogram components;
  const Stopwatch watch(result.cost, CLOCK_PROCESS_CPUTIME_ID);
  const long frames = frame_count(run.scene);
  IncidentTeller incidents(run.choice.step, progress);
  std::optional<std::string> divergence;
  progress.begin("survey", frames);
  try {
    Schedule shown = frame_schedule(run.scene, frames);
    while (interrupted_by() == 0) {
      const auto sample = states.next();
      incidents.tell(states.facts().incidents);
      if (!sample) break;
      if (spool) spool->add(*sample);
      if (!shown.take(sample->time)) continue;
      result.bounds.box.extend(run.drawn.box(sample->state));
      components.add(sample->state.velocity);
      progress.update(shown.taken(), sample->time);
    }
  } catch (const DivergenceError& error) {
    divergence = error.what();
  }
  progress.end();
  if (spool) spool->close(states.facts(), divergence);
  const double scale = components.percentile(shown_share);
  result.bounds.velocity_scale = scale > 0.0 ? scale : 1.0;
  return result;
}

double best_wall_seconds(const Survey& survey, const FilmReport& report, int cores) {
  const double packed = (survey.cost.cpu + report.total.cpu) / cores;
  return std::max(packed, std::min(survey.cost.wall, survey.cost.cpu) + std::max(report.simulate.cpu, report.draw.cpu));
}

FilmReport make_film(const Run& run, StateSource& states, const render::RunBounds& bounds, const FilmPlan& plan,
                     const OutputFolder& folder, int threads, Progress& progress) {
  return Film(run, states, bounds, plan, folder, threads, progress).run();
}

}  // namespace billow::cli
