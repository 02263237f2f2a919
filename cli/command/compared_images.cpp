// Reading both of a pair row by row, side by side.
#include "cli/command/compared_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/suggest.h"
#include "cli/run/output_folder.h"
#include "render/image/png.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

/// A PNG file and the row that was read last.
struct Rows {
  explicit Rows(const fs::path& file) : png(file), row(std::size_t(png.width()) * png.channels()) {}
  void next() { png.read(row.data()); }
  render::RowComparison::Shape shape() const { return {png.width(), png.height(), png.channels()}; }

  render::PngRows png;
  std::vector<std::uint8_t> row;
};

/// What counts of a row: where the mask's luma is at least half of white.
class Mask {
 public:
  Mask(const fs::path& file, const Rows& image) : rows_(file), counts_(static_cast<std::size_t>(image.png.width())) {
    if (rows_.png.width() != image.png.width() || rows_.png.height() != image.png.height())
      throw InputError(fmt::format("{}: the mask has {} x {} pixels and the image {} x {}", file.string(),
                                   rows_.png.width(), rows_.png.height(), image.png.width(), image.png.height()));
  }

  const std::uint8_t* next() {
    rows_.next();
    const std::uint8_t* pixel = rows_.row.data();
    for (std::uint8_t& count : counts_) {
      count = 2126 * pixel[0] + 7152 * pixel[1] + 722 * pixel[2] >= 10000 * 128;
      pixel += rows_.png.channels();
    }
    return counts_.data();
  }

 private:
  Rows rows_;
  std::vector<std::uint8_t> counts_;
};

render::Comparison comparison_of(Rows& a, Rows& b, const ImageTolerance& tolerance) {
  render::RowComparison comparison(a.shape(), b.shape(), tolerance.what);
  std::optional<Mask> mask;
  if (!tolerance.mask.empty()) mask.emplace(tolerance.mask, a);
  for (int y = 0; y < a.png.height(); ++y) {
    a.next(), b.next();
    comparison.add_row(a.row.data(), b.row.data(), mask ? mask->next() : nullptr);
  }
  return comparison.finish();
}

// Of two files that have been compared.
void write_difference(const fs::path& file, const ComparedPair& pair) {
  Rows a(pair.a), b(pair.b);
  const int width = a.png.width();
  render::write_png_rows(file, width, a.png.height(), 3, [&](int, std::uint8_t* row) {
    a.next(), b.next();
    render::difference_row(a.row.data(), a.png.channels(), b.row.data(), b.png.channels(), width, row);
  });
}

// By the tolerance of `baseline`, which may be another version of the same picture.
void judge(ComparedPair& pair, const fs::path& baseline, const CompareOptions& options) {
  try {
    const ImageTolerance tolerance = tolerance_of(baseline, options.tolerance);
    pair.reason = tolerance.reason;
    Rows a(pair.a), b(pair.b);
    pair.verdict = Verdict::different;
    pair.why = fmt::format("{} x {} and {} x {} pixels", a.png.width(), a.png.height(), b.png.width(), b.png.height());
    if (a.png.width() != b.png.width() || a.png.height() != b.png.height()) return;
    pair.comparison = comparison_of(a, b, tolerance);
    pair.why = render::difference_text(*pair.comparison, tolerance.what.threshold);
    if (render::within_tolerance(*pair.comparison, tolerance.allowed)) pair.verdict = Verdict::same;
  } catch (const InputError& error) {
    pair.verdict = Verdict::unreadable;
    pair.why = error.what();
  }
}

bool is_png(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".png";
}

// Paths of all PNG files below `folder`, relative to it.
std::set<std::string> images_below(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->is_regular_file(error) && is_png(entry->path()))
      names.insert(entry->path().lexically_relative(folder).generic_string());
  if (error) throw InputError(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
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
struct Names {
  std::set<std::string> a, b;

  bool is_version(const std::string& name) const { return !b.contains(name) && a.contains(original_of(name)); }

  std::vector<std::string> versions_of(const std::string& original) const {
    std::vector<std::string> versions;
    for (const std::string& name : a)
      if (is_version(name) && original_of(name) == original) versions.push_back(name);
    return versions;
  }
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
    if (other.verdict == Verdict::same) return other;
  }
  return pair;
}

ComparedPair row_of(const std::string& name, const Names& names, const CompareOptions& options) {
  if (names.a.contains(name) && names.b.contains(name)) return judged(name, names, options);
  ComparedPair pair = pair_named(name, options);
  pair.why = "missing in " + (names.a.contains(name) ? options.b : options.a).string();
  return pair;
}

std::vector<ComparedPair> compared_folders(const CompareOptions& options) {
  if (!options.difference.empty())
    throw InputError("--diff takes two images, not two folders; compare the pair that differs");
  const Names names{images_below(options.a), images_below(options.b)};
  if (names.a.empty() && names.b.empty()) throw InputError("neither folder holds a PNG image");
  std::set<std::string> all = names.a;
  all.insert(names.b.begin(), names.b.end());
  std::vector<ComparedPair> pairs;
  for (const std::string& name : all)
    if (!names.is_version(name)) pairs.push_back(row_of(name, names, options));
  return pairs;
}

ComparedPair compared_files(const CompareOptions& options) {
  const std::string a = options.a.filename().string(), b = options.b.filename().string();
  ComparedPair pair{a == b ? a : a + ", " + b, options.a, options.b, {}, {}, {}, {}};
  judge(pair, options.a, options);
  if (pair.verdict == Verdict::unreadable) throw InputError(pair.why);
  if (!options.difference.empty() && pair.comparison) write_difference(options.difference, pair);
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
  check_exists(options.a);
  check_exists(options.b);
  const bool a_is_folder = fs::is_directory(options.a), b_is_folder = fs::is_directory(options.b);
  if (a_is_folder != b_is_folder) throw InputError("compare two images or two folders, not one of each");
  if (a_is_folder) return compared_folders(options);
  return {compared_files(options)};
}

namespace {

void check_accepted_names(const std::vector<ComparedPair>& pairs, const CompareOptions& options) {
  std::vector<std::string_view> known;
  for (const ComparedPair& pair : pairs) known.push_back(pair.name);
  for (const std::string& name : options.accept_only)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("--accept: there is no image '{}'{}", name, suggestion(name, known, "images are")));
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  if (!stream) throw InputError(fmt::format("{}: cannot be read", file.string()));
  return bytes;
}

// Whether there is something in B to copy that is not in A, or not like it.
bool is_to_be_accepted(const ComparedPair& pair, const CompareOptions& options) {
  std::error_code error;
  const auto& names = options.accept_only;
  return pair.verdict == Verdict::different && fs::is_regular_file(pair.b, error) &&
         (names.empty() || std::find(names.begin(), names.end(), pair.name) != names.end());
}

}  // namespace

std::vector<std::string> accept(std::vector<ComparedPair>& pairs, const CompareOptions& options) {
  if (const char* ci = std::getenv("CI"); ci && *ci)
    throw InputError(
        "--accept: CI is set in the environment, and a machine must not accept; do it where somebody looks");
  check_accepted_names(pairs, options);
  std::vector<std::string> accepted;
  for (ComparedPair& pair : pairs) {
    if (!is_to_be_accepted(pair, options)) continue;
    make_folder(pair.a.has_parent_path() ? pair.a.parent_path() : ".");
    write_file_atomically(pair.a, bytes_of(pair.b));
    pair.verdict = Verdict::same;
    pair.why = "accepted";
    accepted.push_back(pair.name);
  }
  return accepted;
}

}  // namespace billow::cli
