// billow compare: two images, or two folders of images by name.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/command/compare_report.h"
#include "cli/command/compared_images.h"
#include "cli/command/compared_sequences.h"
#include "cli/text/json_text.h"
#include "cli/text/terminal.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

// JSON has neither NaN nor infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json bits_of(render::Depth depth) {
  return depth == render::Depth::floats ? Json("float") : Json(depth == render::Depth::bits8 ? 8 : 16);
}

// A hash is a text of eight hexadecimal digits.
Json worst_value(const render::Comparison& c, double value) {
  if (c.worst_meaning == render::Meaning::hash) return render::identity_text(c.worst_meaning, value);
  return number(value);
}

Json as_json(const ComparedPair& pair) {
  Json json = {{"name", pair.name},
               {"a", pair.a.string()},
               {"b", pair.b.string()},
               {"same", pair.verdict == Verdict::same},
               {"readable", pair.verdict != Verdict::unreadable},
               {"why", pair.why}};
  if (!pair.reason.empty()) json["reason"] = pair.reason;
  if (!pair.comparison) return json;
  const render::Comparison& c = *pair.comparison;
  json.update({{"bits", bits_of(c.depth)},
               {"max", number(c.max)},
               {"apart", number(c.apart)},
               {"worst", {c.worst_x, c.worst_y}},
               {"worst_channel", c.worst_channel},
               {"worst_values", {worst_value(c, c.worst_a), worst_value(c, c.worst_b)}},
               {"mean", c.mean},
               {"rmse", c.rmse},
               {"psnr", number(c.psnr)},
               {"ssim", number(c.ssim)},
               {"pixels", c.pixels},
               {"over", c.over},
               {"over_off_edges", c.over_off_edges},
               {"share_over", c.share_over},
               {"explained_by_edges", c.explained},
               {"not_finite", c.not_finite},
               {"both_nan", c.both_nan},
               {"channels", Json::object()}});
  for (const render::ChannelComparison& channel : c.channels)
    json["channels"][channel.name] = {{"max", number(channel.max)}, {"over", channel.over}};
  if (c.flip) json["flip"] = *c.flip;
  return json;
}

Json as_json(const ComparedSequence& sequence, const std::vector<ComparedPair>& pairs) {
  const auto number_of = [](const auto& frame) { return frame ? Json(frame->number) : Json(); };
  Json json = {{"name", sequence.name},
               {"different", sequence.different},
               {"first_different", number_of(sequence.first_different)},
               {"first_unequal", number_of(sequence.first_unequal)},
               {"worst", number_of(sequence.worst)}};
  for (const char* key : {"frames", "same", "max", "rmse", "share_over"}) json[key] = Json::array();
  for (const ComparedSequence::Frame& frame : sequence.frames) {
    const ComparedPair& pair = pairs[frame.pair];
    const auto& c = pair.comparison;
    json["frames"].push_back(frame.number);
    json["same"].push_back(pair.verdict == Verdict::same);
    json["max"].push_back(c ? number(c->max) : Json());
    json["rmse"].push_back(c ? number(c->rmse) : Json());
    json["share_over"].push_back(c ? number(c->share_over) : Json());
  }
  return json;
}

// Four decimals; what is too small or too large for them, as floats can be, with an exponent.
std::string short_number(double value) {
  return value != 0.0 && (value < 0.001 || value >= 10000.0) ? fmt::format("{:.2e}", value)
                                                             : fmt::format("{:.4f}", value);
}

void print_row(const ComparedPair& pair) {
  const std::string reason = pair.reason.empty() ? "" : fmt::format(" (by its own tolerance: {})", pair.reason);
  const std::string same = pair.note.empty() ? "same" : "same: " + pair.why;
  const std::string verdict =
      (pair.verdict == Verdict::same ? same : fmt::format("{}: {}", name_of(pair.verdict), pair.why)) + reason;
  if (!pair.comparison) {
    print_line("{:<32} {:<70}{}", pair.name, "", verdict);
    return;
  }
  const render::Comparison& c = *pair.comparison;
  print_line("{:<32} {:>8.4g} {:>9} {:>9} {:>8.2f} {:>9} {:>8.4f} % {:>8} {}", pair.name, c.max, short_number(c.mean),
             short_number(c.rmse), c.psnr, std::isnan(c.ssim) ? "" : fmt::format("{:.6f}", c.ssim),
             100.0 * c.share_over, c.flip ? fmt::format("{:.5f}", *c.flip) : "", verdict);
}

}  // namespace

void print_table(const std::vector<ComparedPair>& pairs, const CompareOptions& options) {
  const bool flip = std::any_of(pairs.begin(), pairs.end(),
                                [](const ComparedPair& pair) { return pair.comparison && pair.comparison->flip; });
  print_line("{:<32} {:>8} {:>9} {:>9} {:>8} {:>9} {:>10}{}", "image", "max", "mean", "rmse", "psnr dB", "ssim",
             fmt::format("over {:.4g}/255", options.tolerance.what.threshold), flip ? "     flip" : "");
  for (const ComparedPair& pair : pairs) print_row(pair);
  if (pairs.size() == 1) return;
  for (const ComparedSequence& sequence : sequences_of(pairs)) print_line("{}", sequence_text(sequence, pairs));
  const auto same = std::count_if(pairs.begin(), pairs.end(), [](const auto& p) { return p.verdict == Verdict::same; });
  print_line("{} of {} the same", same, pairs.size());
}

Json comparison_json(const std::vector<ComparedPair>& pairs, const std::vector<std::string>& accepted) {
  const bool all_same =
      std::all_of(pairs.begin(), pairs.end(), [](const ComparedPair& pair) { return pair.verdict == Verdict::same; });
  Json json = {{"same", all_same}, {"accepted", accepted}, {"images", Json::array()}, {"sequences", Json::array()}};
  for (const ComparedPair& pair : pairs) json["images"].push_back(as_json(pair));
  for (const ComparedSequence& sequence : sequences_of(pairs)) json["sequences"].push_back(as_json(sequence, pairs));
  return json;
}

// What was found is printed and written before anything is accepted: it is what somebody looks at.
int compare_command(const CompareOptions& options) {
  std::vector<ComparedPair> pairs = compared_images(options);
  const auto all = [&](Verdict verdict) {
    return std::all_of(pairs.begin(), pairs.end(), [&](const ComparedPair& pair) { return pair.verdict == verdict; });
  };
  if (!options.json) print_table(pairs, options);
  if (!options.junit.empty())
    write_junit(options.junit, pairs, fmt::format("billow compare {} {}", options.a.string(), options.b.string()));
  if (!options.report.empty()) write_compare_report(options.report, pairs, options);
  std::vector<std::string> accepted;
  if (options.accept || !options.accept_only.empty()) accepted = accept(pairs, options);
  if (options.json)
    print_json(json_text(comparison_json(pairs, accepted), 2));
  else
    for (const std::string& name : accepted) print_line("accepted {}", name);
  if (all(Verdict::unreadable))
    throw InputError(pairs.size() == 1 ? pairs.front().why : "no pair of images could be read");
  return all(Verdict::same) ? exit_done : exit_images_differ;
}

}  // namespace billow::cli
