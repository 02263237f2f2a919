// caches: in a scene.
#include <fmt/format.h>

#include <algorithm>

#include "cli/scene/cache_format.h"
#include "cli/scene/scene_parts.h"

namespace billow::cli {

Words<CacheFormat> words(CacheFormat) {
  static constexpr Word<CacheFormat> list[] = {{"pc2", CacheFormat::pc2}, {"mdd", CacheFormat::mdd},
                                               {"obj", CacheFormat::obj}, {"ply", CacheFormat::ply},
                                               {"vtp", CacheFormat::vtp}, {"glb", CacheFormat::glb}};
  return list;
}

std::vector<CacheFormat> read_caches(MapReader& scene) {
  std::vector<CacheFormat> caches;
  std::vector<NodePtr> record;
  if (const Node* node = scene.find("caches"))
    for (const NodePtr& item : read_list(*node, "caches")) {
      const auto format = read_choice<CacheFormat>(*item, "cache");
      if (std::find(caches.begin(), caches.end(), format) != caches.end())
        fail_at(item->where, fmt::format("the cache '{}' is listed twice", item->text));
      caches.push_back(format);
      record.push_back(make_scalar(item->text));
    }
  scene.record("caches", make_list(std::move(record)));
  return caches;
}

}  // namespace billow::cli
