// Which recorders a run has.
#include "cli/run/recorder.h"

#include "cli/run/cache_recorder.h"
#include "cli/run/motion_recorder.h"
#include "cli/run/response_recorder.h"
#include "cli/run/spectrum_recorder.h"
#include "cli/run/strip_recorder.h"

namespace billow::cli {

std::vector<std::unique_ptr<Recorder>> make_recorders(const RecorderSetting& setting, FilmReport& report) {
  const Scene& scene = setting.run.scene;
  std::vector<std::unique_ptr<Recorder>> recorders;
  recorders.push_back(std::make_unique<MotionRecorder>(setting, report));
  if (!scene.caches.empty()) recorders.push_back(std::make_unique<CacheRecorder>(setting, report));
  if (const sim::Filter* filter = setting.run.simulation.filter_operator();
      filter && filter->options().target == sim::FilterTarget::force)
    recorders.push_back(std::make_unique<ResponseRecorder>(setting, report));
  if (scene.spectrum) recorders.push_back(std::make_unique<SpectrumRecorder>(setting));
  if (scene.strip) recorders.push_back(std::make_unique<StripRecorder>(setting, report));
  return recorders;
}

}  // namespace billow::cli
