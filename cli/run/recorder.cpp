// Which recorders a run has.
#include "cli/run/recorder.h"

#include <algorithm>

#include "cli/run/cache_recorder.h"
#include "cli/run/glb_recorder.h"
#include "cli/run/motion_recorder.h"
#include "cli/run/response_recorder.h"
#include "cli/run/spectrum_recorder.h"
#include "cli/run/strip_recorder.h"

namespace billow::cli {

std::vector<std::unique_ptr<Recorder>> make_recorders(const RecorderSetting& setting, bool only_frames,
                                                      FilmReport& report) {
  const Scene& scene = setting.run.scene;
  std::vector<std::unique_ptr<Recorder>> recorders;
  recorders.push_back(std::make_unique<MotionRecorder>(setting, report));
  if (const sim::Filter* filter = setting.run.simulation.filter_operator();
      filter && filter->options().target == sim::FilterTarget::force)
    recorders.push_back(std::make_unique<ResponseRecorder>(setting, report));
  if (only_frames) return recorders;
  if (scene.spectrum) recorders.push_back(std::make_unique<SpectrumRecorder>(setting, report));
  if (scene.strip) recorders.push_back(std::make_unique<StripRecorder>(setting, report));
  const auto is_model = [](CacheFormat format) { return format == CacheFormat::glb; };
  if (!std::all_of(scene.caches.begin(), scene.caches.end(), is_model))
    recorders.push_back(std::make_unique<CacheRecorder>(setting, report));
  if (std::any_of(scene.caches.begin(), scene.caches.end(), is_model))
    recorders.push_back(std::make_unique<GlbRecorder>(setting, report));
  return recorders;
}

}  // namespace billow::cli
