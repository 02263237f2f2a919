// Which frames of a run are there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/run/frame_list.h"
#include "cli/scene/scene.h"

namespace billow::cli {

struct FoundFrames {
  std::vector<long> whole;          // in every view, ascending
  std::vector<std::string> faults;  // of files that are there and damaged: "FILE is cut short"
};

/// Looks at the files of the frames `range` of `scene` in `folder`, to their last byte, on all threads.
FoundFrames find_frames(const std::filesystem::path& folder, const Scene& scene, const FrameRange& range);

/// The frames of `range`, ascending.
std::vector<long> frames_of_range(const FrameRange& range);

/// Of the frames `range` those that are not in `there`, ascending.
std::vector<long> missing_frames(const FrameRange& range, const std::vector<long>& there);

}  // namespace billow::cli
