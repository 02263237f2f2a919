// Reading both of a pair row by row, side by side.
#include "cli/command/compared_images.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/regular_file.h"
#include "base/suggest.h"
#include "cli/run/output_folder.h"
#include "cli/text/text_file.h"
#include "render/image/png.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

using render::PngRows;

/// What counts of a row: where the mask's luma is at least half of white.
class Mask {
 public:
  Mask(const fs::path& file, const render::RowShape& image)
      : rows_(opened(file)), counts_(static_cast<std::size_t>(image.width)) {
    if (rows_.width() != image.width || rows_.height() != image.height)
      throw InputError(fmt::format("{}: the mask has {} x {} pixels and the image {} x {}", file.string(),
                                   rows_.width(), rows_.height(), image.width, image.height));
  }

  const std::uint8_t* next() {
    const std::uint8_t* pixel = rows_.next();
    for (std::uint8_t& count : counts_) {
      count = 2126 * pixel[0] + 7152 * pixel[1] + 722 * pixel[2] >= 10000 * 128;
      pixel += rows_.channels();
    }
    return counts_.data();
  }

 private:
  static PngRows opened(const fs::path& file) {
    try {
      return PngRows(file);
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("the mask {}; give a PNG image of the pictures' size, white where it counts", error.what()));
    }
  }

  PngRows rows_;
  std::vector<std::uint8_t> counts_;
};

render::Comparison comparison_of(render::ImagePair& images, const ImageTolerance& tolerance) {
  render::RowComparison comparison(images.shape(), tolerance.what);
  std::optional<Mask> mask;
  if (!tolerance.mask.empty()) mask.emplace(tolerance.mask, images.shape());
  for (int y = 0; y < images.shape().height; ++y) {
    images.next();
    comparison.add_row(images.a(), images.b(), mask ? mask->next() : nullptr);
  }
  return comparison.finish();
}

// Of two files that have been compared.
void write_difference(const fs::path& file, const ComparedPair& pair) {
  render::ImagePair images(pair.a, pair.b);
  render::write_png_rows(file, images.shape().width, images.shape().height, 3, [&](int, std::uint8_t* row) {
    images.next();
    render::difference_row(images.shape(), images.a(), images.b(), row);
  });
}

void check_metrics(const render::Tolerance& tolerance, const render::RowShape& shape) {
  for (const render::MetricLimit& limit : tolerance.metrics)
    if (render::is_of_colours(limit.metric) && !shape.colours())
      throw InputError(
          fmt::format("{} is of colours, and the images have no channels R, G and B; judge them by max or rmse",
                      word_of(limit.metric)));
}

// What of a comparison is worth a word where two images are the same, too.
std::string note_of(const render::Comparison& c, const std::string& odd) {
  std::string note = odd;
  if (c.explained > 0) note += fmt::format("{}{} px explained by edges nearby", note.empty() ? "" : ", ", c.explained);
  if (c.both_nan > 0) note += fmt::format("{}{} NaN in both", note.empty() ? "" : ", ", c.both_nan);
  return note;
}

// By the tolerance of `baseline`, which may be another version of the same picture.
void judge(ComparedPair& pair, const fs::path& baseline, const CompareOptions& options) {
  try {
    const ImageTolerance tolerance = tolerance_of(baseline, options.tolerance);
    pair.reason = tolerance.reason;
    render::ImagePair images(pair.a, pair.b);
    pair.verdict = Verdict::different;
    pair.why = images.mismatch().value_or("");
    if (images.mismatch()) return;
    check_metrics(tolerance.allowed, images.shape());
    pair.comparison = comparison_of(images, tolerance);
    pair.why = render::difference_text(*pair.comparison, tolerance.what.threshold);
    if (!images.note().empty()) pair.why += ", " + images.note();
    pair.note = note_of(*pair.comparison, images.note());
    if (render::within_tolerance(*pair.comparison, tolerance.allowed))
      pair.verdict = Verdict::same;
    else if (const std::string broken = render::broken_limits(*pair.comparison, tolerance.allowed); !broken.empty())
      pair.why = tolerance.allowed.metrics.empty() ? pair.why + "; " + broken : broken + ": " + pair.why;
  } catch (const InputError& error) {
    pair.verdict = Verdict::unreadable;
    pair.why = error.what();
  }
}

bool is_image(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".png" || extension == ".exr";
}

/// What a folder has.
struct FolderNames {
  std::set<std::string> images, tolerances;  // relative to it
  std::map<std::string, std::string> fault;  // of what cannot be looked into, by name
};

// Adds what is in `folder`/`inner` and below.
void look_into(const fs::path& folder, const fs::path& inner, FolderNames& names) {
  std::error_code error;
  fs::directory_iterator entry(folder / inner, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    const fs::path relative = inner / entry->path().filename();
    const std::string name = relative.generic_string();
    std::error_code ignored;
    if (entry->is_directory(ignored) && entry->is_symlink(ignored))
      names.fault[name] = (folder / relative).string() + ": is a link to a folder, which is not followed";
    else if (entry->is_directory(ignored))
      look_into(folder, relative, names);
    else if (is_image(relative))
      names.images.insert(name);
    else if (name.ends_with(tolerance_ending))
      names.tolerances.insert(name);
  }
  if (error && inner.empty()) throw InputError(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  if (error) names.fault[inner.generic_string()] = (folder / inner).string() + ": cannot be read: " + error.message();
}

FolderNames names_below(const fs::path& folder) {
  FolderNames names;
  std::error_code error;
  if (fs::exists(folder, error)) look_into(folder, "", names);
  return names;
}

ComparedPair pair_named(const std::string& name, const CompareOptions& options) {
  return {name, options.a / name, options.b / name, Verdict::different, {}, {}, {}};
}

// NAME.png of which NAME.1.png is another version; empty for a name that is none of a version.
std::string original_of(const std::string& name) {
  const fs::path path(name);
  const std::string number = path.stem().extension().string();
  const bool is_number = number.size() > 1 && number.find_first_not_of("0123456789", 1) == std::string::npos;
  return is_number ? (path.parent_path() / path.stem().stem()).generic_string() + path.extension().string() : "";
}

/// The names in two folders.
class Names {
 public:
  explicit Names(const CompareOptions& options) : a(names_below(options.a)), b(names_below(options.b)) {
    for (const std::string& name : b.images) numbered_in_b_.insert(original_of(name));
    for (const std::string& name : a.images) leave_out_mask_of(name, options);
    for (const std::string& mask : masks_) a.images.erase(mask);
  }

  // Where the second folder has numbers of that name too, they are pictures of their own.
  bool is_version(const std::string& name) const {
    const std::string original = original_of(name);
    return a.images.contains(original) && !b.images.contains(name) && !numbered_in_b_.contains(original);
  }

  std::vector<std::string> versions_of(const std::string& original) const {
    std::vector<std::string> versions;
    for (const std::string& name : a.images)
      if (original_of(name) == original && is_version(name)) versions.push_back(name);
    return versions;
  }

  FolderNames a, b;

 private:
  void leave_out_mask_of(const std::string& name, const CompareOptions& options) {
    try {
      const ImageTolerance tolerance = tolerance_of(options.a / name, {});
      if (!tolerance.mask.empty())
        masks_.insert(
            tolerance.mask.lexically_normal().lexically_relative(options.a.lexically_normal()).generic_string());
    } catch (const InputError&) {  // is told in the picture's own row
    }
  }

  std::set<std::string> masks_, numbered_in_b_;
};

// Against the baseline or, where that differs, the first other version that will do.
ComparedPair judged(const std::string& name, const Names& names, const CompareOptions& options) {
  ComparedPair pair = pair_named(name, options);
  judge(pair, pair.a, options);
  if (pair.verdict == Verdict::same) return pair;
  for (const std::string& version : names.versions_of(name)) {
    ComparedPair other = pair;
    other.a = options.a / version;
    judge(other, pair.a, options);
    if (other.verdict != Verdict::same) continue;
    other.why += ", to " + version;
    other.note = "to " + version;
    return other;
  }
  return pair;
}

// Whether it can be read to its end; why not, if not.
std::optional<std::string> fault_of(const fs::path& file) {
  try {
    render::ImageRows rows(file);
    for (int y = 0; y < rows.shape().height; ++y) rows.next();
    return std::nullopt;
  } catch (const InputError& error) {
    return error.what();
  }
}

ComparedPair row_of(const std::string& name, const Names& names, const CompareOptions& options) {
  const bool in_a = names.a.images.contains(name), in_b = names.b.images.contains(name);
  if (in_a && in_b) return judged(name, names, options);
  ComparedPair pair = pair_named(name, options);
  pair.why = "missing in " + (in_a ? options.b : options.a).string();
  if (const auto fault = fault_of(in_a ? pair.a : pair.b)) pair.verdict = Verdict::unreadable, pair.why = *fault;
  return pair;
}

ComparedPair unreadable(const std::string& name, const std::string& why, const CompareOptions& options) {
  ComparedPair pair = pair_named(name, options);
  pair.verdict = Verdict::unreadable;
  pair.why = why;
  return pair;
}

// Difference images among the pictures would be pictures themselves next time.
void check_differences_folder(const CompareOptions& options) {
  if (options.difference.empty()) return;
  std::error_code error;
  if (fs::exists(options.difference, error) && !fs::is_directory(options.difference, error))
    throw InputError(
        fmt::format("--diff: {} is no folder, and those of two folders go into one", options.difference.string()));
  const fs::path wanted = fs::weakly_canonical(options.difference, error);
  for (const fs::path& folder : {options.a, options.b}) {
    const fs::path below = wanted.lexically_relative(fs::weakly_canonical(folder, error));
    if (!below.empty() && *below.begin() != "..")
      throw InputError(fmt::format("--diff: {} lies in {}, whose images are compared; name another folder",
                                   options.difference.string(), folder.string()));
  }
}

// Of the pairs that differ, by their names: those of NAME.exr are NAME.exr.png.
void write_differences(const std::vector<ComparedPair>& pairs, const fs::path& folder) {
  make_folder(folder);
  for (const ComparedPair& pair : pairs) {
    if (pair.verdict != Verdict::different || !pair.comparison) continue;
    fs::path file = pair.name;
    if (lower_case(file.extension().string()) != ".png") file += ".png";
    make_folder_within(folder, file.parent_path());
    write_difference(folder / file, pair);
  }
}

// Tolerances of pictures that are not there: a slip in a name, most often.
void add_idle_tolerances(const Names& names, const CompareOptions& options, std::vector<ComparedPair>& pairs) {
  for (const std::string& name : names.a.tolerances) {
    const std::string stem = name.substr(0, name.size() - tolerance_ending.size());
    const auto is_its_picture = [&](const std::string& image) { return image.substr(0, image.rfind('.')) == stem; };
    if (std::none_of(names.a.images.begin(), names.a.images.end(), is_its_picture) &&
        std::none_of(names.b.images.begin(), names.b.images.end(), is_its_picture))
      pairs.push_back(
          unreadable(name, fmt::format("there is no picture {0}.png or {0}.exr that it is for", stem), options));
  }
}

}  // namespace

std::vector<ComparedPair> compared_folders(const CompareOptions& options) {
  check_differences_folder(options);
  const Names names(options);
  std::set<std::string> all = names.a.images;
  all.insert(names.b.images.begin(), names.b.images.end());
  std::vector<ComparedPair> pairs;
  for (const std::string& name : all)
    if (!names.is_version(name)) pairs.push_back(row_of(name, names, options));
  std::map<std::string, std::string> faults = names.a.fault;
  faults.insert(names.b.fault.begin(), names.b.fault.end());
  for (const auto& [name, why] : faults) pairs.push_back(unreadable(name, why, options));
  add_idle_tolerances(names, options, pairs);
  if (pairs.empty())
    throw InputError(
        fmt::format("there is no PNG or OpenEXR image in {}, nor in {}", options.b.string(), options.a.string()));
  if (!options.difference.empty()) write_differences(pairs, options.difference);
  return pairs;
}

ComparedPair compared_picture(const std::string& name, const CompareOptions& options) {
  return row_of(name, Names(options), options);
}

namespace {

bool is_same_file(const fs::path& one, const fs::path& other) {
  std::error_code error;
  return fs::equivalent(one, other, error);
}

ComparedPair compared_files(const CompareOptions& options) {
  const std::string a = options.a.filename().string(), b = options.b.filename().string();
  ComparedPair pair{a == b ? a : a + ", " + b, options.a, options.b, {}, {}, {}, {}};
  if (is_same_file(options.difference, options.a) || is_same_file(options.difference, options.b))
    throw InputError("--diff would replace one of the images; name another file");
  judge(pair, options.a, options);
  if (options.difference.empty()) return pair;
  if (pair.comparison)
    write_difference(options.difference, pair);
  else
    pair.why += "; no difference image is written";
  return pair;
}

void check_exists(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(path.string() + ": there is no such file or folder");
}

}  // namespace

const char* name_of(Verdict verdict) {
  return verdict == Verdict::same ? "same" : verdict == Verdict::different ? "DIFFERENT" : "UNREADABLE";
}

std::vector<ComparedPair> compared_images(const CompareOptions& options) {
  check_exists(options.b);
  const bool accepts = options.accept || !options.accept_only.empty();
  if (accepts && !fs::exists(options.a) && fs::is_directory(options.b)) return compared_folders(options);
  check_exists(options.a);
  const bool a_is_folder = fs::is_directory(options.a), b_is_folder = fs::is_directory(options.b);
  if (a_is_folder != b_is_folder) throw InputError("compare two images or two folders, not one of each");
  if (a_is_folder) return compared_folders(options);
  return {compared_files(options)};
}

namespace {

bool is_asked_for(const ComparedPair& pair, const CompareOptions& options) {
  const auto& names = options.accept_only;
  return options.accept || std::find(names.begin(), names.end(), pair.name) != names.end();
}

// Names that are none of the pairs', or whose picture in B is not to be had.
void check_accepted_names(const std::vector<ComparedPair>& pairs, const CompareOptions& options) {
  std::vector<std::string_view> known;
  for (const ComparedPair& pair : pairs) known.push_back(pair.name);
  for (const std::string& name : options.accept_only) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end())
      throw InputError(
          fmt::format("--accept-only: there is no image '{}'{}", name, suggestion(name, known, "images are")));
    const ComparedPair& pair = pairs[static_cast<std::size_t>(found - known.begin())];
    if (const auto fault = fault_of(pair.b)) throw InputError(fmt::format("--accept-only: {}", *fault));
    if (!can_be_accepted(pair)) throw InputError(fmt::format("--accept-only: {}: {}", pair.name, pair.why));
  }
}

void copy(const ComparedPair& pair, const CompareOptions& options) {
  if (fs::is_directory(options.b)) {
    make_folder(options.a);
    make_folder_within(options.a, fs::path(pair.name).parent_path());
  }
  if (fs::is_symlink(pair.a)) throw OutputError(fmt::format("{} is a link, which is not replaced", pair.a.string()));
  write_file_atomically(pair.a, read_regular_file(pair.b));
}

}  // namespace

void check_may_accept(std::string_view option) {
  if (const char* ci = std::getenv("CI"); ci && *ci)
    throw InputError(fmt::format(
        "{}: CI is set in the environment, and a machine must not accept; do it where somebody looks", option));
}

bool can_be_accepted(const ComparedPair& pair) {
  if (pair.verdict == Verdict::same || fault_of(pair.b)) return false;
  std::error_code error;
  return pair.verdict == Verdict::different || !fs::exists(pair.a, error) || fault_of(pair.a).has_value();
}

std::vector<std::string> accept(std::vector<ComparedPair>& pairs, const CompareOptions& options) {
  check_may_accept("--accept");
  check_accepted_names(pairs, options);
  std::vector<std::string> accepted;
  for (ComparedPair& pair : pairs) {
    if (!is_asked_for(pair, options) || !can_be_accepted(pair)) continue;
    try {
      copy(pair, options);
    } catch (const OutputError& error) {
      throw OutputError(fmt::format("{}; accepted until then: {}", error.what(),
                                    accepted.empty() ? "nothing" : fmt::format("{}", fmt::join(accepted, ", "))));
    }
    pair.verdict = Verdict::same;
    pair.why = "accepted";
    accepted.push_back(pair.name);
  }
  return accepted;
}

}  // namespace billow::cli
