// The words of a scene's picture settings.
#include "render/image/settings.h"

namespace billow::render {

Words<VelocityColour> words(VelocityColour) {
  static constexpr Word<VelocityColour> list[] = {{"magnitude", VelocityColour::magnitude},
                                                  {"components", VelocityColour::components}};
  return list;
}

}  // namespace billow::render
