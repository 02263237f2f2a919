// Colours as scenes write them: sRGB, "#rrggbb" or [r, g, b] in [0, 1].
#include "cli/yaml/colour_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/srgb.h"

namespace billow::cli {
namespace {

constexpr Range unit_range{0.0, 1.0};

Eigen::Vector3f to_linear(const Eigen::Vector3d& srgb) {
  return srgb.unaryExpr([](double c) { return srgb_to_linear(c); }).cast<float>();
}

// "#rrggbb" -> sRGB in [0, 1].
std::optional<Eigen::Vector3d> parse_hex(const std::string& text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  Eigen::Vector3d srgb;
  for (int i = 0; i < 3; ++i) {
    unsigned value = 0;
    const char* begin = text.data() + 1 + 2 * i;
    if (const auto result = std::from_chars(begin, begin + 2, value, 16); result.ptr != begin + 2) return std::nullopt;
    srgb(i) = value / 255.0;
  }
  return srgb;
}

// The colour in sRGB as the file has it, and how to write it again.
struct WrittenColour {
  Eigen::Vector3d srgb;
  NodePtr record;
};

WrittenColour parse_colour(const Node& node, std::string_view name) {
  if (node.kind == Node::Kind::list) {
    const Eigen::Vector3d srgb = read_vector(node, name, unit_range);
    return {srgb, record_of(srgb)};
  }
  const auto srgb = node.kind == Node::Kind::scalar ? parse_hex(node.text) : std::nullopt;
  if (!srgb)
    fail_at(node.where, fmt::format("{} must be \"#rrggbb\", quotes included, or [r, g, b] from 0 to 1", name));
  std::string lower = node.text;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) { return c >= 'A' && c <= 'F' ? c + 32 : c; });
  return {*srgb, make_scalar(lower, true)};
}

}  // namespace

Eigen::Vector3f read_colour(const Node& node, std::string_view name) {
  return to_linear(parse_colour(node, name).srgb);
}

const Node* find_colour(const MapReader& map, std::string_view key) {
  return map.find(key, "; a colour that begins with # needs quotes");
}

// The default passes through its text, so that the record reads back to exactly the same colour.
Eigen::Vector3f read_colour(MapReader& map, std::string_view key, const Eigen::Vector3f& fallback) {
  const NodePtr default_text = make_scalar(hex_colour(fallback), true);
  const Node* node = find_colour(map, key);
  const WrittenColour colour = parse_colour(node ? *node : *default_text, key);
  map.record(key, colour.record);
  return to_linear(colour.srgb);
}

std::string hex_colour(const Eigen::Vector3f& linear) {
  const auto byte = [](float c) { return std::lround(255.0 * linear_to_srgb(std::clamp(c, 0.0f, 1.0f))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(linear(0)), byte(linear(1)), byte(linear(2)));
}

}  // namespace billow::cli
