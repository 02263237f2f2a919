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
#include "cli/text/json_text.h"
#include "cli/text/terminal.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

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
  json.update({{"max", c.max},
               {"worst", {c.worst_x, c.worst_y}},
               {"mean", c.mean},
               {"rmse", c.rmse},
               {"psnr", std::isfinite(c.psnr) ? Json(c.psnr) : Json()},
               {"ssim", c.ssim},
               {"pixels", c.pixels},
               {"over", c.over},
               {"over_off_edges", c.over_off_edges},
               {"share_over", c.share_over}});
  if (c.flip) json["flip"] = *c.flip;
  return json;
}

void print_row(const ComparedPair& pair) {
  const std::string reason = pair.reason.empty() ? "" : fmt::format(" (by its own tolerance: {})", pair.reason);
  const std::string same = pair.why.find(", to ") == std::string::npos ? "same" : "same: " + pair.why;
  const std::string verdict =
      (pair.verdict == Verdict::same ? same : fmt::format("{}: {}", name_of(pair.verdict), pair.why)) + reason;
  if (!pair.comparison) {
    print_line("{:<32} {:<66}{}", pair.name, "", verdict);
    return;
  }
  const render::Comparison& c = *pair.comparison;
  print_line("{:<32} {:>4} {:>9.4f} {:>9.4f} {:>8.2f} {:>9.6f} {:>8.4f} % {:>8} {}", pair.name, c.max, c.mean, c.rmse,
             c.psnr, c.ssim, 100.0 * c.share_over, c.flip ? fmt::format("{:.5f}", *c.flip) : "", verdict);
}

}  // namespace

void print_table(const std::vector<ComparedPair>& pairs, const CompareOptions& options) {
  const bool flip = std::any_of(pairs.begin(), pairs.end(),
                                [](const ComparedPair& pair) { return pair.comparison && pair.comparison->flip; });
  print_line("{:<32} {:>4} {:>9} {:>9} {:>8} {:>9} {:>10} {:>8}", "image", "max", "mean", "rmse", "psnr dB", "ssim",
             fmt::format("over {}/255", options.tolerance.what.threshold), flip ? "flip" : "");
  for (const ComparedPair& pair : pairs) print_row(pair);
  if (pairs.size() == 1) return;
  const auto same = std::count_if(pairs.begin(), pairs.end(), [](const auto& p) { return p.verdict == Verdict::same; });
  print_line("{} of {} the same", same, pairs.size());
}

Json comparison_json(const std::vector<ComparedPair>& pairs, const std::vector<std::string>& accepted) {
  const bool all_same =
      std::all_of(pairs.begin(), pairs.end(), [](const ComparedPair& pair) { return pair.verdict == Verdict::same; });
  Json json = {{"same", all_same}, {"accepted", accepted}, {"images", Json::array()}};
  for (const ComparedPair& pair : pairs) json["images"].push_back(as_json(pair));
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
