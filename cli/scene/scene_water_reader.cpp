// water: in a scene.
#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_parts.h"

namespace billow::cli {

void read_water(MapReader& map, Scene& scene) {
  MapReader water = map.map("water", keys::section("water"));
  scene.water.resistance = water.number("resistance", scene.water.resistance);
  scene.water.velocity = water.vector("current", scene.water.velocity);
  scene.motes = water.integer("motes", scene.motes);
}

}  // namespace billow::cli
