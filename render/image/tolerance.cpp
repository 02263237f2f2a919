// Comparison -> same or not, and why in a line.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "render/image/compare.h"

namespace billow::render {

Words<Metric> words(Metric) {
  static constexpr Word<Metric> list[] = {{"max", Metric::max},
                                          {"rmse", Metric::rmse},
                                          {"psnr", Metric::psnr},
                                          {"ssim", Metric::ssim},
                                          {"flip", Metric::flip}};
  return list;
}

bool is_of_colours(Metric metric) { return metric == Metric::ssim || metric == Metric::flip; }

double largest(Metric metric) {
  switch (metric) {
    case Metric::max:
    case Metric::rmse:
      return 1e30;  // floats have units of their own
    case Metric::psnr:
      return 1000.0;
    case Metric::ssim:
    case Metric::flip:
      return 1.0;
  }
  throw std::logic_error("a metric has no largest value");
}

namespace {

double value_of(const Comparison& c, Metric metric) {
  switch (metric) {
    case Metric::max:
      return c.max;
    case Metric::rmse:
      return c.rmse;
    case Metric::psnr:
      return c.psnr;
    case Metric::ssim:
      return c.ssim;
    case Metric::flip:
      return c.flip.value_or(1.0);
  }
  throw std::logic_error("a metric has no value");
}

bool is_high_for_alike(Metric metric) { return metric == Metric::psnr || metric == Metric::ssim; }

bool holds(const Comparison& c, const MetricLimit& m) {
  if (c.not_finite > 0 && !is_of_colours(m.metric)) return false;
  const double value = value_of(c, m.metric);
  return is_high_for_alike(m.metric) ? value >= m.limit : value <= m.limit;
}

bool are_few(const Comparison& c, const Tolerance& tolerance) {
  return tolerance.pixels ? c.over <= *tolerance.pixels : c.share_over <= tolerance.share;
}

}  // namespace

std::string identity_text(Meaning meaning, double value) {
  return meaning == Meaning::hash ? fmt::format("{:08x}", std::bit_cast<std::uint32_t>(static_cast<float>(value)))
                                  : fmt::format("{:.0f}", value);
}

bool within_tolerance(const Comparison& comparison, const Tolerance& tolerance) {
  if (!tolerance.metrics.empty())
    return std::all_of(tolerance.metrics.begin(), tolerance.metrics.end(),
                       [&](const MetricLimit& limit) { return holds(comparison, limit); });
  return comparison.apart <= tolerance.worst && are_few(comparison, tolerance);
}

namespace {

// "3/255"; of floats in their own units, where they are at most 1.
std::string threshold_text(const Comparison& c, double threshold) {
  return c.depth == Depth::floats ? fmt::format("{:.3g}", threshold / 255.0) : fmt::format("{:.4g}/255", threshold);
}

// "31"; of identities "another hash"; what 8 bits do not have in their own steps too: "0.003891 (1/65535)".
std::string worst_text(const Comparison& c) {
  const std::string at = fmt::format("at ({}, {})", c.worst_x, c.worst_y);
  if (c.worst_meaning != Meaning::quantity)
    return fmt::format("another {} in {} {}: {} and {}", c.worst_meaning == Meaning::hash ? "hash" : "number",
                       c.worst_channel, at, identity_text(c.worst_meaning, c.worst_a),
                       identity_text(c.worst_meaning, c.worst_b));
  if (c.depth == Depth::floats) {
    const double difference = std::abs(c.worst_a - c.worst_b);
    // As many digits as tell them apart.
    const int digits = fmt::format("{:.6g}", c.worst_a) == fmt::format("{:.6g}", c.worst_b) ? 10 : 6;
    return fmt::format("worst {} in {} {}: {:.{}g} and {:.{}g}",
                       std::isfinite(difference) ? fmt::format("{:.4g}", difference) : "infinite", c.worst_channel, at,
                       c.worst_a, digits, c.worst_b, digits);
  }
  const double steps = c.max * 257.0;
  const bool is_whole = c.depth == Depth::bits8 || std::abs(c.max - std::round(c.max)) < 1e-6;
  return fmt::format("worst {:.4g}{} {}", c.max, is_whole ? "" : fmt::format(" ({:.0f}/65535)", steps), at);
}

std::string places_text(const Comparison& c) {
  if (c.over_off_edges == 0) return "all within 1 px of an edge";
  if (c.over_off_edges == c.over) return "none at an edge";
  return fmt::format("{} off any edge", c.over_off_edges);
}

// What is said of values beside their differences.
std::string asides(const Comparison& c) {
  std::string text;
  if (c.explained > 0) text += fmt::format(", {} px explained by edges nearby", c.explained);
  if (c.not_finite > 0)
    text += fmt::format(", {} {} NaN or infinite in one alone", c.not_finite, c.not_finite == 1 ? "value" : "values");
  if (c.both_nan > 0) text += fmt::format(", {} {} NaN in both", c.both_nan, c.both_nan == 1 ? "value" : "values");
  return text;
}

}  // namespace

namespace {

std::int64_t allowed_over(const Comparison& c, const Tolerance& tolerance) {
  return tolerance.pixels.value_or(
      static_cast<std::int64_t>(std::floor(tolerance.share * static_cast<double>(c.pixels))));
}

// In the unit of the worst difference: of 255, or of the channel, of large values in proportion to them.
double allowed_worst(const Comparison& c, const Tolerance& tolerance) {
  if (c.depth != Depth::floats) return tolerance.worst;
  double scale = 1.0;
  for (const double value : {c.worst_a, c.worst_b})
    if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
  return tolerance.worst / 255.0 * scale;
}

}  // namespace

std::string broken_limits(const Comparison& comparison, const Tolerance& tolerance) {
  std::vector<std::string> broken;
  for (const MetricLimit& limit : tolerance.metrics)
    if (!holds(comparison, limit))
      broken.push_back(fmt::format("{} {:.4g} and not {} {:.4g}", word_of(limit.metric),
                                   value_of(comparison, limit.metric),
                                   is_high_for_alike(limit.metric) ? "at least" : "at most", limit.limit));
  if (!tolerance.metrics.empty()) return fmt::format("{}", fmt::join(broken, ", "));
  if (!are_few(comparison, tolerance)) broken.push_back(fmt::format("{} px over", allowed_over(comparison, tolerance)));
  if (comparison.apart > tolerance.worst && comparison.worst_meaning == Meaning::quantity)
    broken.push_back(fmt::format("worst {:.4g}", allowed_worst(comparison, tolerance)));
  return broken.empty() ? "" : fmt::format("allowed: {}", fmt::join(broken, ", "));
}

std::string difference_text(const Comparison& c, double threshold) {
  if (c.apart == 0.0) return "equal" + asides(c);
  const std::string limit = threshold_text(c, threshold);
  if (c.over == 0) return fmt::format("no pixel over {}, {}{}", limit, worst_text(c), asides(c));
  const double percent = 100.0 * c.share_over;
  return fmt::format("{} px over {} ({:.{}g} %), {}, {}{}", c.over, limit, percent, percent < 10.0 ? 2 : 3,
                     worst_text(c), places_text(c), asides(c));
}

}  // namespace billow::render
