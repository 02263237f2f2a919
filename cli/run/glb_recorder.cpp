// States -> caches/scene.glb.
#include "cli/run/glb_recorder.h"

#include <algorithm>

#include "base/atomic_file.h"
#include "cli/cache/base64.h"
#include "cli/run/film.h"

namespace billow::cli {

namespace {

// The frame of key k [from 0].
long frame_of_key(long key, const FrameRange& range) {
  const long frames = range.last - range.first + 1, keys = std::min(GlbRecorder::most_keys, frames);
  if (keys < 2) return range.first;
  return range.first + (key * (frames - 1) + (keys - 1) / 2) / (keys - 1);
}

std::vector<GlbPart> parts_of(const Run& run) {
  std::vector<GlbPart> parts;
  for (const BodySpec& body : run.scene.bodies) parts.push_back({body.name, "body", {}});
  for (const ColliderSpec& collider : run.scene.colliders) parts.push_back({collider.solid.name, "collider", {}});
  std::vector<render::DrawnBody> solids = run.drawn.solids();
  for (std::size_t p = 0; p < parts.size(); ++p) parts[p].drawn = std::move(solids[p]);
  return parts;
}

}  // namespace

GlbRecorder::GlbRecorder(const RecorderSetting& setting, FilmReport& report)
    : setting_(setting), report_(report), frames_(frame_schedule(setting.run.scene, setting.range.last)) {}

void GlbRecorder::add(double time, const sim::State& state) {
  if (!frames_.take(time) || frames_.taken() != frame_of_key(static_cast<long>(keys_.size()), setting_.range)) return;
  GlbKey key{time, {}};
  for (sim::SurfaceState& surface : setting_.run.drawn.solid_surfaces(state))
    key.positions.push_back(std::move(surface.position));
  keys_.push_back(std::move(key));
}

// A page that is opened from its file may not read another file, but may load a script.
void GlbRecorder::finish() {
  if (keys_.empty()) return;
  const std::string bytes = glb_file(parts_of(setting_.run), keys_, setting_.run.drawn.origin());
  make_folder_within(setting_.folder.path(), setting_.folder.caches().filename());
  write_file_atomically(setting_.folder.file(RunFile::glb), bytes);
  write_file_atomically(setting_.folder.file(RunFile::glb_script), "window.billow_glb = \"" + base64(bytes) + "\";\n");
  report_.caches.push_back({CacheFormat::glb, "", std::filesystem::path(word_of(RunFile::glb)), setting_.range.first,
                            static_cast<long>(keys_.size())});
}

}  // namespace billow::cli
