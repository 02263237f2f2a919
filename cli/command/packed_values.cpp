// Layers that are worth a look -> planes of bytes.
#include "cli/command/packed_values.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "base/error.h"
#include "cli/cache/base64.h"
#include "render/image/image_rows.h"
#include "render/image/png.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_values = std::size_t{32} << 18;  // of an image: 32 MiB
constexpr std::size_t most_rows = 16384;                    // that canvases of every browser hold

/// Channels that are looked at together.
struct Layer {
  std::string name;
  std::vector<std::size_t> channels;
  std::int64_t over = 0;
  double max = 0.0;
};

// Colours in the order in which they are seen; OpenEXR sorts by name.
int rank_in_layer(const std::string& channel) {
  const std::size_t place = std::string_view("RGBA").find(channel.back());
  return place == std::string_view::npos ? 4 : static_cast<int>(place);
}

std::vector<Layer> layers_of(const render::RowShape& shape, const std::optional<render::Comparison>& comparison) {
  std::vector<Layer> layers;
  for (std::size_t c = 0; c < shape.channels.size(); ++c) {
    const std::string name = render::layer_of(shape.channels[c].name);
    auto layer = std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == name; });
    if (layer == layers.end()) layer = layers.insert(layers.end(), {name, {}, 0, 0.0});
    layer->channels.push_back(c);
    if (!comparison) continue;
    for (const render::ChannelComparison& found : comparison->channels)
      if (found.name == shape.channels[c].name) layer->over += found.over, layer->max = std::max(layer->max, found.max);
  }
  for (Layer& layer : layers)
    std::stable_sort(layer.channels.begin(), layer.channels.end(), [&](std::size_t a, std::size_t b) {
      return rank_in_layer(shape.channels[a].name) < rank_in_layer(shape.channels[b].name);
    });
  return layers;
}

// Colours first, then what differs most.
std::vector<Layer> shown_layers(const render::RowShape& shape, const std::optional<render::Comparison>& comparison) {
  std::vector<Layer> layers = layers_of(shape, comparison);
  std::stable_sort(layers.begin(), layers.end(), [](const Layer& a, const Layer& b) {
    return std::make_tuple(a.name == "colour", a.over, a.max) > std::make_tuple(b.name == "colour", b.over, b.max);
  });
  const std::size_t pixels = static_cast<std::size_t>(shape.width) * shape.height;
  std::vector<Layer> shown;
  std::size_t count = 0;
  for (const Layer& layer : layers) {
    const bool is_equal = comparison && layer.max == 0.0 && layer.over == 0 && !shown.empty();
    const std::size_t with_it = count + layer.channels.size();
    if (is_equal || with_it * pixels > most_values || (4 * with_it + 2) / 3 * shape.height > most_rows) continue;
    shown.push_back(layer);
    count = with_it;
  }
  return shown;
}

// The values of the layers' channels, each image's own places for them.
Json packed_side(const std::filesystem::path& file, const std::vector<std::string>& channels) {
  try {
    render::ImageRows rows(file);
    const render::RowShape& shape = rows.shape();
    std::vector<Eigen::Index> source;
    for (const std::string& name : channels) {
      const auto found = std::find_if(shape.channels.begin(), shape.channels.end(),
                                      [&](const render::RowChannel& channel) { return channel.name == name; });
      source.push_back(found == shape.channels.end() ? -1 : found - shape.channels.begin());
    }
    const std::size_t planes = 4 * channels.size(), blocks = (planes + 2) / 3;
    render::Image picture(shape.width, static_cast<int>(blocks * shape.height));
    for (int y = 0; y < shape.height; ++y) {
      const render::ValueRow& row = rows.next();
      for (std::size_t p = 0; p < planes; ++p) {
        const Eigen::Index c = source[p / 4];
        std::uint8_t* to = picture.row(static_cast<int>(p / 3) * shape.height + y) + p % 3;
        for (int x = 0; x < shape.width; ++x, to += 3) {
          const double value = c < 0 ? render::white_of(shape.depth) : row(x, c);
          *to = static_cast<std::uint8_t>(std::bit_cast<std::uint32_t>(static_cast<float>(value)) >> (8 * (p % 4)));
        }
      }
    }
    return {{"width", shape.width},
            {"height", shape.height},
            {"data", "data:image/png;base64," + base64(render::encode_png(picture))}};
  } catch (const InputError&) {  // missing or damaged, which the pair's row says
    return {};
  }
}

std::optional<render::RowShape> shape_of(const std::filesystem::path& file) {
  try {
    return render::ImageRows(file).shape();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

Json packed_values(const ComparedPair& pair) {
  const auto a = shape_of(pair.a), b = shape_of(pair.b);
  if (!a && !b) return {};
  const render::RowShape& shape = a && (!b || a->depth >= b->depth) ? *a : *b;
  if (shape.depth == render::Depth::bits8) return {};
  Json json = {{"white", render::white_of(shape.depth)}, {"layer", 0}, {"layers", Json::array()}};
  std::vector<std::string> channels;
  for (const Layer& layer : shown_layers(shape, pair.comparison)) {
    Json names = Json::array(), identities = Json::array(), hashes = Json::array();
    for (const std::size_t c : layer.channels) {
      if (shape.channels[c].exact()) identities.push_back(shape.channels[c].name);
      if (shape.channels[c].meaning == render::Meaning::hash) hashes.push_back(shape.channels[c].name);
      names.push_back(shape.channels[c].name);
      channels.push_back(shape.channels[c].name);
      if (pair.comparison && pair.comparison->worst_channel == channels.back()) json["layer"] = json["layers"].size();
    }
    json["layers"].push_back(
        {{"name", layer.name}, {"channels", names}, {"identities", identities}, {"hashes", hashes}});
  }
  if (channels.empty()) return {};
  json["a"] = packed_side(pair.a, channels);
  json["b"] = packed_side(pair.b, channels);
  return json;
}

}  // namespace billow::cli
