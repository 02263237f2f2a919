// List of maps -> keys of a rigid motion.
#include "cli/scene/motion_reader.h"

#include <fmt/format.h>

#include <numbers>

#include "cli/scene/scene_keys.h"

namespace billow::cli {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

sim::PlaceKey read_place_key(const Node& node, const NodePtr& record) {
  MapReader map(node, keys::section("bodies[].cloth.pins[].motion[]"), record);
  sim::PlaceKey key;
  key.time = map.number("time");
  key.translation = map.vector("translate", key.translation);
  key.rotation = degree * map.vector("rotate", key.rotation);
  return key;
}

}  // namespace

std::vector<sim::PlaceKey> read_place_keys(MapReader& map, std::string_view key) {
  std::vector<sim::PlaceKey> keys;
  std::vector<NodePtr> record;
  if (const Node* node = map.find(key))
    for (const NodePtr& item : read_list(*node, key)) {
      record.push_back(make_map());
      keys.push_back(read_place_key(*item, record.back()));
      if (keys.size() > 1 && !(keys.back().time > keys[keys.size() - 2].time))
        fail_at(item->where,
                fmt::format("{}[{}] is no later than the one before it; sort the keys by time", key, keys.size() - 1));
    }
  map.record(key, make_list(std::move(record)));
  return keys;
}

sim::KeyedMotion read_motion(MapReader& map, std::string_view key, const Eigen::Vector3d& pivot) {
  return {read_place_keys(map, key), pivot};
}

}  // namespace billow::cli
