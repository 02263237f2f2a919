// Looking at every picture of a run.
#include "cli/run/whole_frames.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <system_error>

#include "cli/run/output_folder.h"
#include "render/image/picture.h"

namespace billow::cli {

namespace {

/// What became of a frame's files.
struct FrameFiles {
  bool whole = true;
  std::vector<std::string> faults;
};

FrameFiles look_at_frame(const std::filesystem::path& folder, const Scene& scene, long frame) {
  FrameFiles files;
  for (const render::View view : scene.render.views) {
    const std::filesystem::path file = frame_of(folder, view, frame);
    std::error_code error;
    const bool there = std::filesystem::is_regular_file(file, error);
    const auto fault = there ? render::picture_fault(file, scene.render.width, scene.render.height) : std::nullopt;
    if (fault) files.faults.push_back(fmt::format("{} {}", file.string(), *fault));
    files.whole = files.whole && there && !fault;
  }
  return files;
}

}  // namespace

FoundFrames find_frames(const std::filesystem::path& folder, const Scene& scene, const FrameRange& range) {
  std::vector<FrameFiles> files(static_cast<std::size_t>(std::max(0L, range.last - range.first + 1)));
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t k) {
    const long frame = range.first + static_cast<long>(k);
    if (range.contains(frame)) files[k] = look_at_frame(folder, scene, frame);
  });
  FoundFrames found;
  for (std::size_t k = 0; k < files.size(); ++k) {
    const long frame = range.first + static_cast<long>(k);
    if (range.contains(frame) && files[k].whole) found.whole.push_back(frame);
    found.faults.insert(found.faults.end(), files[k].faults.begin(), files[k].faults.end());
  }
  return found;
}

std::vector<long> frames_of_range(const FrameRange& range) {
  std::vector<long> frames;
  for (long frame = range.first; frame <= range.last; ++frame)
    if (range.contains(frame)) frames.push_back(frame);
  return frames;
}

std::vector<long> missing_frames(const FrameRange& range, const std::vector<long>& there) {
  std::vector<long> missing = frames_of_range(range);
  std::erase_if(missing, [&](long frame) { return std::binary_search(there.begin(), there.end(), frame); });
  return missing;
}

}  // namespace billow::cli
