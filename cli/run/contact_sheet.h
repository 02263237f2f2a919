// Frames of a run side by side on one page, with their times.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "cli/run/finished_run.h"
#include "render/image/image.h"

namespace billow::cli {

/// Numbers and times [s] of frames.
using TimedFrames = std::vector<std::pair<long, double>>;

/// `wanted` of the frames at equal distances, as far as whole frames can; the first and the last are among them.
TimedFrames evenly_chosen(const TimedFrames& frames, std::size_t wanted);

/// The frames `chosen` of the run in so many columns; 0: about as many as there are rows. Throws InputError where there
/// are none, or where one is missing.
render::Image contact_sheet(const FinishedRun& run, const std::vector<render::View>& views, const TimedFrames& chosen,
                            std::size_t columns);

}  // namespace billow::cli
