// The words of a scene's picture settings.
#include "render/image/settings.h"

namespace billow::render {

Words<VelocityColour> words(VelocityColour) {
  static constexpr Word<VelocityColour> list[] = {{"magnitude", VelocityColour::magnitude},
                                                  {"components", VelocityColour::components}};
  return list;
}

Settings seen_from(Settings settings, const Eigen::Vector3d& origin) {
  settings.camera.eye -= origin;
  settings.camera.look_at -= origin;
  for (CameraKey& key : settings.camera.keys) key.eye -= origin, key.look_at -= origin;
  if (settings.ground_height) *settings.ground_height -= origin.y();
  return settings;
}

}  // namespace billow::render
