// wind: in a scene.
#include <fmt/format.h>

#include <algorithm>

#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_parts.h"
#include "cli/text/number_text.h"

namespace billow::cli {
namespace {

std::optional<sim::Gusts> read_gusts(MapReader& wind, double speed) {
  if (wind.is_none("gusts")) return std::nullopt;
  MapReader map = wind.map("gusts", keys::section("wind.gusts"));
  sim::Gusts gusts;
  gusts.strength = map.number("strength", gusts.strength);
  gusts.period = map.number("period", gusts.period);
  // As far as the wind comes in that time: what gusts are that drift by unchanged. Still air has none.
  const double drifted = speed > 0.0 ? speed * gusts.period : gusts.length;
  gusts.length = map.number_or_word("length").value_or(drifted);
  gusts.seed = static_cast<std::uint64_t>(map.integer("seed", static_cast<int>(gusts.seed)));
  return gusts;
}

void read_coefficients(MapReader& map, sim::Wind& wind) {
  wind.drag = map.number("drag", wind.drag);
  const double most_lift = sim::Wind::most_lift * wind.drag;
  wind.lift = map.number("lift", most_lift);
  if (wind.lift > most_lift)
    fail_at(map.where("lift"),
            fmt::format("lift is {}; with a drag of {} it must be at most {}, {} of that", shortest(wind.lift),
                        shortest(wind.drag), shortest(most_lift), shortest(sim::Wind::most_lift)));
}

}  // namespace

std::optional<sim::Wind> read_wind(MapReader& scene) {
  constexpr double least_quadratic_to = 20.0;  // [m/s] faster than cloth flaps
  if (scene.is_none("wind")) return std::nullopt;
  MapReader map = scene.map("wind", keys::section("wind"));
  sim::Wind wind;
  wind.velocity = map.vector("velocity", wind.velocity);
  const double speed = wind.velocity.norm();
  wind.gusts = read_gusts(map, speed);
  read_coefficients(map, wind);
  wind.density = map.number("density", wind.density);
  wind.quadratic_to = map.number_or_word("quadratic_to").value_or(std::max(least_quadratic_to, 2.0 * speed));
  return wind;
}

}  // namespace billow::cli
