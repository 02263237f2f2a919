// Pairs -> a page with the pictures inside.
#include "cli/command/compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <tuple>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/regular_file.h"
#include "base/xml.h"
#include "cli/cache/base64.h"
#include "cli/command/compared_sequences.h"
#include "cli/command/packed_values.h"
#include "cli/page/line_plot.h"
#include "cli/page/page_file.h"
#include "cli/page/report_page.h"
#include "cli/run/output_folder.h"
#include "cli/text/json_text.h"
#include "render/image/colour_map.h"
#include "render/image/flip.h"
#include "render/image/image_rows.h"
#include "render/image/png.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_pictures = 40;  // that a page holds
constexpr std::string_view mark_of_page = "<section class=\"comparison\"";

// What needs a look first comes first.
bool needs_a_look_before(const ComparedPair& a, const ComparedPair& b) {
  const auto rank = [](const ComparedPair& pair) {
    const bool whole = pair.comparison.has_value();
    return std::make_tuple(pair.verdict == Verdict::unreadable  ? 0
                           : pair.verdict == Verdict::different ? 1
                                                                : 2,
                           whole, whole ? -pair.comparison->share_over : 0.0, whole ? -pair.comparison->apart : 0.0);
  };
  return rank(a) != rank(b) ? rank(a) < rank(b) : a.name < b.name;
}

std::string data_uri(std::string_view png) { return "data:image/png;base64," + base64(png); }

// A file as it is; nothing where there is none, or where it is too large for a page that can be sent.
Json file_uri(const fs::path& file) {
  constexpr std::uintmax_t most = 32 << 20;  // [byte]
  try {
    return data_uri(read_regular_file(file, most));
  } catch (const InputError&) {
    return {};
  }
}

// ꟻLIP's errors as colours; their mean is the pair's where nobody has asked for it before.
Json flip_uri(ComparedPair& pair) {
  if (!pair.comparison) return {};
  double sum = 0.0;
  render::ImagePair images(pair.a, pair.b);
  const render::RowShape& shape = images.shape();
  if (!shape.colours()) return {};
  render::Image map(shape.width, shape.height);
  render::Flip flip(map.width, map.height, [&](int y, const Eigen::ArrayXd& errors) {
    sum += errors.sum();
    for (int x = 0; x < map.width; ++x) {
      const render::Rgb8 colour = render::magnitude_rgb(errors(x));
      std::copy(colour.begin(), colour.end(), map.row(y) + 3 * x);
    }
  });
  for (int y = 0; y < map.height; ++y) {
    images.next();
    flip.add_row(seen_row(shape, images.a()).data(), 3, seen_row(shape, images.b()).data(), 3);
  }
  flip.finish();
  const double pixels = double(map.width) * map.height;
  if (!pair.comparison->flip && pair.comparison->pixels == static_cast<std::int64_t>(pixels))
    pair.comparison->flip = sum / pixels;  // no mask
  return data_uri(render::encode_png(map));
}

Json picture_of(ComparedPair& pair) {
  Json json = {{"name", pair.name},
               {"a", pair.a.string()},
               {"b", pair.b.string()},
               {"why", fmt::format("{}: {}", name_of(pair.verdict), pair.why)}};
  if (pair.comparison) json["worst"] = {pair.comparison->worst_x, pair.comparison->worst_y};
  json["values"] = packed_values(pair);
  const bool is_decoded = json["values"].is_null() && pair.a.extension() != ".exr";
  json["data_a"] = is_decoded ? file_uri(pair.a) : Json();
  json["data_b"] = is_decoded ? file_uri(pair.b) : Json();
  json["data_flip"] = flip_uri(pair);
  return json;
}

// What a curve over the frames shows of each.
PlotLine curve(const std::string& name, const std::string& colour, const ComparedSequence& sequence,
               const std::vector<ComparedPair>& pairs, double (*value)(const render::Comparison&)) {
  PlotLine line{name, colour, {}};
  for (const ComparedSequence::Frame& frame : sequence.frames)
    if (const auto& c = pairs[frame.pair].comparison)
      line.points.push_back({static_cast<double>(frame.number), value(*c)});
  return line;
}

// The frames of which the page has pictures: their numbers and the pictures' places.
Json frames_with_pictures(const ComparedSequence& sequence) {
  Json frames = Json::array();
  for (const ComparedSequence::Frame& frame : sequence.frames)
    if (frame.pair < most_pictures) frames.push_back({frame.number, frame.pair});
  return frames;
}

std::string curves(const ComparedSequence& sequence, const std::vector<ComparedPair>& pairs, double threshold) {
  const double first = static_cast<double>(sequence.frames.front().number),
               last = static_cast<double>(sequence.frames.back().number);
  const auto plot = [&](const std::string& title, const std::string& unit, std::vector<PlotLine> lines) {
    return line_plot(
        {.title = title, .unit = unit, .begin = first, .end = last, .lines = std::move(lines), .by_frame = true});
  };
  const auto& sample = pairs[sequence.frames.front().pair].comparison;
  const bool is_float = sample && sample->depth == render::Depth::floats;
  return fmt::format(
      "<section class=\"curves\" data-begin=\"{}\" data-end=\"{}\" data-frames=\"{}\">\n<h2>{}</h2>\n<p "
      "class=\"summary\">{}</p>\n{}{}</section>\n",
      first, last, frames_with_pictures(sequence).dump(), xml_escape(sequence.name),
      xml_escape(sequence_text(sequence, pairs)),
      plot(fmt::format("pixels over {:.4g}/255", threshold), "%",
           {curve("share", "1", sequence, pairs, [](const render::Comparison& c) { return 100.0 * c.share_over; })}),
      plot("differences", is_float ? "own units" : "of 255",
           {curve("largest", "1", sequence, pairs, [](const render::Comparison& c) { return c.max; }),
            curve("rmse", "2", sequence, pairs, [](const render::Comparison& c) { return c.rmse; })}));
}

std::string numbers(const ComparedPair& pair) {
  if (!pair.comparison) return "<td></td><td></td><td></td><td></td><td></td><td></td>";
  const render::Comparison& c = *pair.comparison;
  const auto cell = [](const std::string& text) { return fmt::format("<td class=\"number\">{}</td>", text); };
  return cell(std::isfinite(c.max) ? fmt::format("{:.4g}", c.max) : "∞") +
         cell(c.rmse != 0.0 && (c.rmse < 0.001 || c.rmse >= 1e5) ? fmt::format("{:.1e}", c.rmse)
                                                                 : fmt::format("{:.3f}", c.rmse)) +
         cell(std::isfinite(c.psnr) ? fmt::format("{:.1f} dB", c.psnr) : "∞") +
         cell(std::isnan(c.ssim) ? "" : fmt::format("{:.5f}", c.ssim)) +
         cell(c.flip ? fmt::format("{:.4f}", *c.flip) : "") + cell(fmt::format("{:.3g} %", 100.0 * c.share_over));
}

std::string row_of(const ComparedPair& pair, std::size_t number) {
  const bool shown = number < most_pictures;
  const std::string name = xml_escape(pair.name);
  const std::string reason = pair.reason.empty() ? "" : fmt::format("; its own tolerance: {}", pair.reason);
  return fmt::format("<tr{}{}><td>{}</td><td>{}</td>{}<td>{}</td></tr>\n",
                     shown ? fmt::format(" data-picture=\"{}\"", number) : "",
                     pair.verdict == Verdict::same ? "" : " class=\"bad\"",
                     shown ? fmt::format("<button type=\"button\">{}</button>", name) : name, name_of(pair.verdict),
                     numbers(pair), xml_escape(pair.why + reason));
}

std::string summary(const std::vector<ComparedPair>& pairs) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(pairs.begin(), pairs.end(), [&](const ComparedPair& pair) { return pair.verdict == verdict; });
  };
  std::string text = fmt::format("{} of {} the same", count(Verdict::same), pairs.size());
  if (const auto different = count(Verdict::different)) text += fmt::format(", {} different", different);
  if (const auto unreadable = count(Verdict::unreadable)) text += fmt::format(", {} unreadable", unreadable);
  if (pairs.size() > most_pictures) text += fmt::format("; the first {} can be looked at here", most_pictures);
  return text;
}

// Only a page of this kind.
void check_replaceable(const fs::path& page) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(page, error)) && read_regular_file(page).find(mark_of_page) == std::string::npos)
    throw OutputError(
        fmt::format("{} is there and no page of a comparison; choose another folder with --report", page.string()));
}

}  // namespace

void write_compare_report(const fs::path& folder, std::vector<ComparedPair> pairs, const CompareOptions& options) {
  std::sort(pairs.begin(), pairs.end(), needs_a_look_before);
  std::string rows;
  Json pictures = Json::array();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (k < most_pictures) pictures.push_back(picture_of(pairs[k]));
    rows += row_of(pairs[k], k);
  }
  const std::string title = fmt::format("{} and {}", options.a.string(), options.b.string());
  std::string sections;
  for (const ComparedSequence& sequence : sequences_of(pairs))
    sections += curves(sequence, pairs, options.tolerance.what.threshold);
  const std::string json = json_text(pictures);
  const std::string body =
      fill_template(page_file("compare.html"), {{"title", xml_escape(title)},
                                                {"summary", xml_escape(summary(pairs))},
                                                {"threshold", fmt::format("{:.4g}", options.tolerance.what.threshold)},
                                                {"curves", sections},
                                                {"rows", rows},
                                                {"pictures", json_for_script(json)}});
  make_folder(folder);
  check_replaceable(folder / "index.html");
  write_file_atomically(folder / "index.html", html_page(title, body, {"compare.js"}));
}

}  // namespace billow::cli
