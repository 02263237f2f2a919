// A map of a file -> ImageTolerance.
#include "cli/golden/image_tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "cli/yaml/yaml_reader.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

// Whether `one` lets through what `usual` does not, as far as they can be compared.
bool lets_more_through(const render::Tolerance& one, const render::Tolerance& usual) {
  if (one.worst > usual.worst) return true;
  if (one.pixels == 0) return false;
  return one.pixels && usual.pixels ? *one.pixels > *usual.pixels
                                    : one.pixels.has_value() != usual.pixels.has_value() || one.share > usual.share;
}

// Whether the map does nothing but let less through: then nobody has to ask why.
bool is_stricter(const Node& node, const ImageTolerance& tolerance, const ImageTolerance& usual) {
  const std::vector<std::string_view> plain = {"reason", "channel", "worst", "pixels"};
  const auto is_plain = [&](const Entry& entry) {
    return std::find(plain.begin(), plain.end(), entry.key) != plain.end();
  };
  return std::all_of(node.entries.begin(), node.entries.end(), is_plain) && usual.allowed.metrics.empty() &&
         tolerance.what.threshold <= usual.what.threshold && !lets_more_through(tolerance.allowed, usual.allowed);
}

std::string read_reason(MapReader& map) {
  const Node& node = map.require("reason", "; say why this picture needs another tolerance");
  std::string reason = map.text("reason");
  if (reason.find_first_not_of(" \t\r\n") == std::string::npos)
    fail_at(node.where, "the reason is empty; say why this picture needs another tolerance");
  return reason;
}

void read_pixels_of(MapReader& map, render::Tolerance& tolerance) {
  const Node* node = map.find("pixels");
  if (!node) return;
  tolerance.pixels.reset();
  const std::string text = read_text(*node, "pixels");
  if (!read_pixels(text, tolerance))
    fail_at(node->where, fmt::format("pixels is '{}', and should be a number like 250 or a share like 0.5%", text));
}

void read_share_of(MapReader& map, const char* key, double& of_255) {
  const Node* node = map.find(key);
  if (!node) return;
  const std::string text = read_text(*node, key);
  if (!read_share_of_white(text, of_255))
    fail_at(node->where,
            fmt::format("{} is '{}', and should be from 0 to 255 or a share of white like 0.1%", key, text));
}

void read_metrics(MapReader& map, render::Tolerance& tolerance) {
  const Node* node = map.find("metrics");
  if (!node) return;
  tolerance.metrics.clear();
  MapReader metrics = map.map_from(node, "metrics", metric_keys());
  for (const auto& [name, metric] : render::words(render::Metric()))
    if (metrics.find(name)) tolerance.metrics.push_back({metric, metrics.number(name)});
  if (tolerance.metrics.empty()) fail_at(node->where, "metrics is empty; give at least one, like {ssim: 0.99}");
}

}  // namespace

bool read_pixels(const std::string& text, render::Tolerance& tolerance) {
  const char* const end = text.data() + text.size();
  double number = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  const bool is_share = rest + 1 == end && *rest == '%';
  const bool is_count = rest == end && number == std::floor(number) && number < 1e15;
  if (error != std::errc() || !(number >= 0.0) || !(is_share ? number <= 100.0 : is_count)) return false;
  if (is_share)
    tolerance.share = number / 100.0;
  else
    tolerance.pixels = static_cast<std::int64_t>(number);
  return true;
}

bool read_share_of_white(const std::string& text, double& of_255) {
  const char* const end = text.data() + text.size();
  double number = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  const bool is_percent = rest + 1 == end && *rest == '%';
  if (is_percent) number *= 2.55;
  if (error != std::errc() || !(is_percent || rest == end) || !(number >= 0.0 && number <= 255.0)) return false;
  of_255 = number;
  return true;
}

const Section& tolerance_keys() {
  static const Section keys{"the tolerance",
                            {{"reason"},
                             {"channel"},
                             {"pixels"},
                             {"worst"},
                             {"edge", {0, render::largest_edge, false, "pixel"}},
                             {"ignore_alpha"},
                             {"mask"},
                             {"metrics"}}};
  return keys;
}

const Section& metric_keys() {
  static const Section keys = [] {
    Section all{"metrics", {}};
    for (const auto& [name, metric] : render::words(render::Metric()))
      all.keys.push_back({name, {0.0, render::largest(metric)}});
    return all;
  }();
  return keys;
}

ImageTolerance read_tolerance(const Node& node, const fs::path& folder, const ImageTolerance& usual, ReasonFor reason) {
  ImageTolerance tolerance = usual;
  MapReader map(node, tolerance_keys(), make_map());
  if (map.find("reason") || reason == ReasonFor::anything) tolerance.reason = read_reason(map);
  read_share_of(map, "channel", tolerance.what.threshold);
  read_share_of(map, "worst", tolerance.allowed.worst);
  tolerance.what.edge = map.integer("edge", usual.what.edge);
  tolerance.what.ignore_alpha = map.boolean("ignore_alpha", usual.what.ignore_alpha);
  if (map.find("mask")) tolerance.mask = folder / map.text("mask");
  read_pixels_of(map, tolerance.allowed);
  if (map.find("channel") || map.find("worst") || map.find("pixels")) tolerance.allowed.metrics.clear();
  read_metrics(map, tolerance.allowed);
  const auto& metrics = tolerance.allowed.metrics;
  tolerance.what.flip = std::any_of(metrics.begin(), metrics.end(),
                                    [](const auto& limit) { return limit.metric == render::Metric::flip; });
  if (!map.find("reason") && !is_stricter(node, tolerance, usual))
    fail_at(node.where, "this may let through what is usually a difference; say why with the key 'reason'");
  return tolerance;
}

ImageTolerance tolerance_of(const fs::path& baseline, const ImageTolerance& usual) {
  fs::path file = baseline;
  file.replace_extension(tolerance_ending);
  std::error_code error;
  if (!fs::exists(fs::symlink_status(file, error))) return usual;  // a link to nothing is a fault
  return read_tolerance(*read_yaml_file(file), file.parent_path(), usual, ReasonFor::anything);
}

}  // namespace billow::cli
