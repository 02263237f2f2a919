// billow compare: two images, or two folders of images by name.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "cli/command/application.h"
#include "cli/command/commands.h"
#include "cli/text/json_text.h"
#include "render/image/compare.h"
#include "render/image/png.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// One pair of images; without a comparison where only one of them exists.
struct Pair {
  std::string name;
  std::optional<render::Comparison> comparison;
  std::string missing_in;
};

// Paths of all PNG files below `folder`, relative to it, in order of name.
std::set<std::string> images_below(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".png")
      names.insert(entry.path().lexically_relative(folder).generic_string());
  return names;
}

void check_exists(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(path.string() + ": there is no such file or folder");
}

Pair compared(const std::string& name, const fs::path& a, const fs::path& b, const fs::path& difference) {
  const render::Image first = render::read_png(a), second = render::read_png(b);
  Pair pair{name, render::compare(first, second), ""};
  if (!difference.empty()) render::write_png(difference, render::difference(first, second));
  return pair;
}

std::vector<Pair> compared_folders(const CompareOptions& options) {
  if (!options.difference.empty())
    throw InputError("--diff takes two images, not two folders; compare the pair that differs");
  const std::set<std::string> a = images_below(options.a), b = images_below(options.b);
  if (a.empty() && b.empty()) throw InputError("neither folder holds a PNG image");
  std::set<std::string> names = a;
  names.insert(b.begin(), b.end());
  std::vector<Pair> pairs;
  for (const std::string& name : names) {
    if (!a.contains(name))
      pairs.push_back({name, {}, options.a.string()});
    else if (!b.contains(name))
      pairs.push_back({name, {}, options.b.string()});
    else
      pairs.push_back(compared(name, options.a / name, options.b / name, {}));
  }
  return pairs;
}

std::vector<Pair> compared_pairs(const CompareOptions& options) {
  check_exists(options.a);
  check_exists(options.b);
  const bool a_is_folder = fs::is_directory(options.a), b_is_folder = fs::is_directory(options.b);
  if (a_is_folder != b_is_folder) throw InputError("compare two images or two folders, not one of each");
  if (a_is_folder) return compared_folders(options);
  return {compared(options.b.filename().string(), options.a, options.b, options.difference)};
}

bool same(const Pair& pair) { return pair.comparison && render::within_tolerance(*pair.comparison); }

Json as_json(const Pair& pair) {
  if (!pair.comparison) return {{"name", pair.name}, {"missing_in", pair.missing_in}, {"same", false}};
  const render::Comparison& c = *pair.comparison;
  return {{"name", pair.name},
          {"max", c.max},
          {"mean", c.mean},
          {"rmse", c.rmse},
          {"psnr", std::isfinite(c.psnr) ? Json(c.psnr) : Json()},
          {"ssim", c.ssim},
          {"share_over", c.share_over},
          {"same", same(pair)}};
}

void print_line(const Pair& pair) {
  if (!pair.comparison) {
    fmt::print("{:<32} missing in {}\n", pair.name, pair.missing_in);
    return;
  }
  const render::Comparison& c = *pair.comparison;
  fmt::print("{:<32} {:>4} {:>9.4f} {:>9.4f} {:>8.2f} {:>9.6f} {:>8.4f} %  {}\n", pair.name, c.max, c.mean, c.rmse,
             c.psnr, c.ssim, 100.0 * c.share_over, same(pair) ? "same" : "DIFFERENT");
}

}  // namespace

int compare_command(const CompareOptions& options) {
  const std::vector<Pair> pairs = compared_pairs(options);
  const bool all_same = std::all_of(pairs.begin(), pairs.end(), same);
  if (options.json) {
    Json json = {{"same", all_same}, {"images", Json::array()}};
    for (const Pair& pair : pairs) json["images"].push_back(as_json(pair));
    fmt::print("{}\n", json_text(json, 2));
  } else {
    fmt::print("{:<32} {:>4} {:>9} {:>9} {:>8} {:>9} {:>10}\n", "image", "max", "mean", "rmse", "psnr dB", "ssim",
               "over 3/255");
    for (const Pair& pair : pairs) print_line(pair);
  }
  return all_same ? exit_done : exit_images_differ;
}

}  // namespace billow::cli
