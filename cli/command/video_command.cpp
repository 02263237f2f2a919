// billow video: a run's frames as a film, by ffmpeg.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/atomic_file.h"
#include "base/child_process.h"
#include "base/error.h"
#include "base/readable_number.h"
#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/run/finished_run.h"
#include "cli/run/interrupt.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

// Even sides, which 4:2:0 needs, and the colours that players take HD to have.
constexpr char video_colours[] =
    "pad=ceil(iw/2)*2:ceil(ih/2)*2,"
    "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+bitexact,format=yuv420p";

/// A kind of film. Numbers of threads are fixed: the encoders' bytes depend on them.
struct FilmFormat {
  std::string_view extension, muxer, filter;
  Arguments encoding;
  bool paletted = false;
};

const std::vector<FilmFormat>& film_formats() {
  static const Arguments tags = {"-colorspace",  "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
                                 "-color_range", "tv",    "-threads",         "4"};
  const auto tagged = [](Arguments encoding) {
    encoding.insert(encoding.end(), tags.begin(), tags.end());
    return encoding;
  };
  static const std::vector<FilmFormat> formats = {
      {".mp4", "mp4", video_colours,
       tagged({"-c:v", "libx264", "-preset", "medium", "-crf", "18", "-movflags", "+faststart"})},
      {".webm", "webm", video_colours,
       tagged({"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-deadline", "good", "-cpu-used", "4", "-tile-columns",
               "2"})},
      {".gif", "gif", "null", {"-c:v", "gif", "-loop", "0"}, true},
      {".apng", "apng", "null", {"-c:v", "apng", "-pred", "mixed", "-plays", "0"}}};
  return formats;
}

const FilmFormat& format_of(const fs::path& file) {
  std::vector<std::string_view> known;
  for (const FilmFormat& format : film_formats()) {
    if (file.extension() == format.extension) return format;
    known.push_back(format.extension);
  }
  throw InputError(fmt::format("-o {}: a film's name ends in {}", file.string(), fmt::join(known, ", ")));
}

// A file, for ffmpeg: without the word a colon in its name would make it an address. Ffmpeg works in the run's folder.
std::string named(const fs::path& file) { return "file:" + file.string(); }

// Every file of the film, one view after the other within a frame. From within the run's folder, where a frame's name
// is plain: ffmpeg's lists have no way to write some that the folder itself may have.
std::string list_of_files(const FinishedRun& run, const std::vector<render::View>& views) {
  std::string list = "ffconcat version 1.0\n";
  for (const auto& [frame, time] : run.frames)
    for (const render::View view : views)
      list += "file " + named(frame_file(run, view, frame).lexically_relative(run.folder)) + "\n";
  return list;
}

std::string complaint(const ProgramResult& result) {
  if (!result.found) return "ffmpeg is missing; install it: apt-get install ffmpeg";
  const std::string first = result.errors.substr(0, result.errors.find('\n'));
  return first.empty() ? fmt::format("ffmpeg ended with status {}", result.status) : "ffmpeg: " + first;
}

// The last "frame=N" of ffmpeg's progress.
long frames_in(std::string_view output) {
  const std::size_t place = output.rfind("frame=");
  long frames = 0;
  if (place != std::string_view::npos)
    std::from_chars(output.data() + place + 6, output.data() + output.size(), frames);
  return frames;
}

/// One film on its way through ffmpeg, which may take several goes.
class FilmMaker {
 public:
  FilmMaker(const FinishedRun& run, const std::vector<render::View>& views, double fps, const fs::path& file,
            Progress& progress)
      : folder_(run.folder),
        file_(file),
        list_(list_of_files(run, views)),
        frames_(static_cast<long>(run.frames.size())),
        fps_(fps),
        progress_(progress) {
    input_ = {"-r",
              fmt::format("{}", fps * static_cast<double>(views.size())),
              "-f",
              "concat",
              "-safe",
              "0",
              "-protocol_whitelist",
              "file,pipe",
              "-i",
              "pipe:0"};
    if (views.size() > 1) side_by_side_ = fmt::format("tile={}x1,", views.size());
  }

  /// Writes the film to `temporary`. False when a signal asked for the end.
  bool make(const FilmFormat& format, const fs::path& temporary) {
    if (!format.paletted) return encode(format, {"-vf", side_by_side_ + std::string(format.filter)}, temporary);
    const AtomicFile palette(file_.string() + ".palette");  // never commited: it vanishes with this function
    if (!ffmpeg("palette", {"-vf", side_by_side_ + "palettegen", "-f", "image2", "-c:v", "png", "-update", "1",
                            named(fs::absolute(palette.temporary()))}))
      return false;
    return encode(format,
                  {"-f", "png_pipe", "-i", named(fs::absolute(palette.temporary())), "-lavfi",
                   "[0:v]" + side_by_side_ + "null[film];[film][1:v]paletteuse=diff_mode=rectangle"},
                  temporary);
  }

 private:
  bool encode(const FilmFormat& format, Arguments words, const fs::path& temporary) {
    words.insert(words.end(), format.encoding.begin(), format.encoding.end());
    words.insert(words.end(), {"-f", std::string(format.muxer), named(fs::absolute(temporary))});
    return ffmpeg("film", words);
  }

  bool ffmpeg(std::string_view stage, const Arguments& words) {
    Arguments all = {"ffmpeg", "-nostdin", "-y", "-v", "error", "-xerror", "-progress", "pipe:1"};
    all.insert(all.end(), input_.begin(), input_.end());
    // Nothing in the file may depend on when and where it is made.
    const Arguments exact = {"-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"};
    const std::size_t before_output = words.size() - 1;
    all.insert(all.end(), words.begin(), words.begin() + static_cast<std::ptrdiff_t>(before_output));
    all.insert(all.end(), exact.begin(), exact.end());
    all.push_back(words.back());
    progress_.begin(stage, frames_);
    const ProgramResult result = run_program(
        all, list_, std::numeric_limits<double>::infinity(),
        [&](auto output) {
          if (const long done = frames_in(output); done > 0) progress_.update(done, static_cast<double>(done) / fps_);
          return interrupted_by() == 0;
        },
        folder_);
    progress_.end();
    if (interrupted_by() != 0) return false;
    if (!result.found || result.status != 0 || !result.errors.empty())
      throw OutputError(fmt::format("cannot write {}: {}", file_.string(), complaint(result)));
    return true;
  }

  fs::path folder_, file_;
  std::string list_;
  long frames_;
  double fps_;
  Progress& progress_;
  Arguments input_;
  std::string side_by_side_;
};

}  // namespace

int video_command(const VideoOptions& options) {
  const FinishedRun run = read_finished_run(options.folder);
  const std::vector<render::View> views = chosen_views(run, options.views);
  const fs::path file = options.output.empty() ? run.folder / (joined_names(views) + ".mp4") : options.output;
  const FilmFormat& format = format_of(file);
  check_replaceable(file, options.overwrite);
  if (run.frames.empty()) throw InputError(run.folder.string() + ": the run has no frames");
  const double fps = options.fps > 0.0 ? options.fps : run.fps;
  Progress progress(options.progress);
  FilmMaker maker(run, views, fps, file, progress);
  catch_interrupts();
  AtomicFile output(file);
  if (!maker.make(format, output.temporary())) return 128 + interrupted_by();
  output.commit();
  progress.say(fmt::format("wrote {} ({} at {} fps)", file.string(),
                           counted(static_cast<long>(run.frames.size()), "frame"), fps));
  return exit_done;
}

}  // namespace billow::cli
