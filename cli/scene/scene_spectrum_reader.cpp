// spectrum: in a scene.
#include <fmt/format.h>

#include <algorithm>

#include "base/suggest.h"
#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_parts.h"
#include "cli/text/number_text.h"

namespace billow::cli {
namespace {

// The cloth of that name, or the first one.
int find_cloth(MapReader& map, const std::vector<BodyDraft>& drafts) {
  std::vector<std::string_view> cloths;
  for (const BodyDraft& draft : drafts)
    if (takes_spectrum(draft.spec)) cloths.push_back(draft.spec.name);
  const Node* given = map.find("body");
  if (cloths.empty()) fail_at(map.where(), "a spectrum is taken of a cloth, and the scene has none; remove 'spectrum'");
  const std::string wanted = given ? read_text(*given, "body") : std::string(cloths.front());
  if (std::find(cloths.begin(), cloths.end(), wanted) == cloths.end())
    fail_at(map.where("body"),
            fmt::format("there is no cloth '{}'{}", wanted, suggestion(wanted, cloths, "cloths are")));
  map.record("body", make_scalar(wanted));
  const auto body =
      std::find_if(drafts.begin(), drafts.end(), [&](const BodyDraft& d) { return d.spec.name == wanted; });
  return static_cast<int>(body - drafts.begin());
}

}  // namespace

std::optional<SpectrumSpec> read_spectrum(MapReader& scene, double duration, const std::vector<BodyDraft>& drafts) {
  if (scene.is_none("spectrum")) return std::nullopt;
  MapReader map = scene.map("spectrum", keys::section("spectrum"));
  SpectrumSpec spectrum;
  spectrum.step = map.number("step", spectrum.step);
  spectrum.at = map.number("at", std::min(spectrum.at, duration));
  if (spectrum.at > duration)
    fail_at(map.where("at"),
            fmt::format("at is {} s, and the scene ends at {} s", shortest(spectrum.at), shortest(duration)));
  spectrum.range = map.number("range", spectrum.range);
  spectrum.window = map.choice("window", spectrum.window);
  spectrum.body = find_cloth(map, drafts);
  return spectrum;
}

}  // namespace billow::cli
