// Which particles are held when.
#include "cli/scene/scene_pins.h"

#include <algorithm>
#include <set>

namespace billow::cli {

namespace {

bool holds(const PinSpec& pin, double time) { return !pin.until || *pin.until > time; }

}  // namespace

std::vector<int> held_vertices(const std::vector<PinSpec>& pins, double time) {
  std::set<int> held;
  for (const PinSpec& pin : pins)
    if (holds(pin, time)) held.insert(pin.vertices.begin(), pin.vertices.end());
  return {held.begin(), held.end()};
}

std::vector<double> release_times(const Scene& scene) {
  std::set<double> times;
  for (const BodySpec& body : scene.bodies)
    for (const PinSpec& pin : body.pins)
      if (pin.until && *pin.until < scene.duration) times.insert(*pin.until);
  return {times.begin(), times.end()};
}

sim::Structure released(const Scene& scene, sim::Structure structure, double time) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const std::vector<PinSpec>& pins = scene.bodies[b].pins;
    const int first = structure.body[b].first_particle;
    const std::vector<int> held = held_vertices(pins, time);
    for (const int v : held_vertices(pins, 0.0))
      if (!std::binary_search(held.begin(), held.end(), v))
        structure.inverse_mass(first + v) = 1.0 / structure.mass(first + v);
  }
  return structure;
}

std::vector<sim::MovingPin> moving_pins(const Scene& scene, const sim::Structure& structure, double time) {
  std::vector<sim::MovingPin> moving;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    for (const PinSpec& pin : scene.bodies[b].pins) {
      if (!pin.motion.moves() || !holds(pin, time)) continue;
      moving.push_back({pin.vertices, pin.motion});
      for (int& particle : moving.back().particle) particle += structure.body[b].first_particle;
    }
  return moving;
}

}  // namespace billow::cli
