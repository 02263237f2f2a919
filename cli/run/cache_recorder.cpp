// State -> caches.
#include "cli/run/cache_recorder.h"

#include "cli/run/film.h"

namespace billow::cli {

CacheRecorder::CacheRecorder(const RecorderSetting& setting, FilmReport& report)
    : folder_(setting.folder.caches()),
      range_(setting.range),
      frames_(frame_schedule(setting.run.scene, setting.range.last)),
      report_(report),
      geometry_(setting.run) {
  make_folder_within(setting.folder.path(), folder_.filename());
  make_writers(setting.run.scene.caches);
}

void CacheRecorder::make_writers(const std::vector<CacheFormat>& formats) {
  const std::vector<CacheMesh>& meshes = geometry_.meshes();
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (const CacheFormat format : formats) {
      if (has_file_per_frame(format)) make_folder_within(folder_, meshes[m].name);
      if (auto writer = make_cache_writer(format, folder_, meshes[m]))
        output_.push_back({format, m, std::move(writer)});
    }
}

void CacheRecorder::add(double time, const sim::State& state) {
  const double frame_time = frames_.next();
  if (!frames_.take(time) || !range_.contains(frames_.taken())) return;
  const std::vector<CacheFrame> frames = geometry_.at(frames_.taken(), frame_time, state);
  for (const Output& output : output_) output.writer->add(frames[output.mesh]);
  ++written_;
}

void CacheRecorder::finish() {
  if (written_ == 0) return;
  for (const CacheMesh& mesh : geometry_.meshes()) write_obj(folder_ / (mesh.name + ".rest.obj"), mesh, mesh.rest);
  for (const Output& output : output_) {
    output.writer->finish();
    const CacheMesh& mesh = geometry_.meshes()[output.mesh];
    report_.caches.push_back({output.format, mesh.name, folder_.filename() / output.writer->file(), range_.first,
                              written_, mesh.layout.vertices()});
  }
}

}  // namespace billow::cli
