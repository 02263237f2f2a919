// Reading both of a pair row by row, side by side.
#include "cli/command/compared_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <set>

#include "base/error.h"
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

render::Comparison comparison_of(Rows& a, Rows& b, const CompareOptions& options) {
  render::RowComparison comparison(a.shape(), b.shape(), options.what);
  std::optional<Mask> mask;
  if (!options.mask.empty()) mask.emplace(options.mask, a);
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

void judge(ComparedPair& pair, const CompareOptions& options) {
  try {
    Rows a(pair.a), b(pair.b);
    pair.verdict = Verdict::different;
    pair.why = fmt::format("{} x {} and {} x {} pixels", a.png.width(), a.png.height(), b.png.width(), b.png.height());
    if (a.png.width() != b.png.width() || a.png.height() != b.png.height()) return;
    pair.comparison = comparison_of(a, b, options);
    pair.why = render::difference_text(*pair.comparison, options.what.threshold);
    if (render::within_tolerance(*pair.comparison, options.tolerance)) pair.verdict = Verdict::same;
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

ComparedPair missing(const std::string& name, const CompareOptions& options, const fs::path& folder) {
  return {name, options.a / name, options.b / name, Verdict::different, "missing in " + folder.string(), {}};
}

std::vector<ComparedPair> compared_folders(const CompareOptions& options) {
  if (!options.difference.empty())
    throw InputError("--diff takes two images, not two folders; compare the pair that differs");
  const std::set<std::string> a = images_below(options.a), b = images_below(options.b);
  if (a.empty() && b.empty()) throw InputError("neither folder holds a PNG image");
  std::set<std::string> names = a;
  names.insert(b.begin(), b.end());
  std::vector<ComparedPair> pairs;
  for (const std::string& name : names) {
    if (!a.contains(name) || !b.contains(name)) {
      pairs.push_back(missing(name, options, a.contains(name) ? options.b : options.a));
      continue;
    }
    judge(pairs.emplace_back(ComparedPair{name, options.a / name, options.b / name, {}, {}, {}}), options);
  }
  return pairs;
}

ComparedPair compared_files(const CompareOptions& options) {
  const std::string a = options.a.filename().string(), b = options.b.filename().string();
  ComparedPair pair{a == b ? a : a + ", " + b, options.a, options.b, {}, {}, {}};
  judge(pair, options);
  if (pair.verdict == Verdict::unreadable) throw InputError(pair.why);
  if (!options.difference.empty() && pair.comparison) write_difference(options.difference, pair);
  return pair;
}

void check_exists(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(path.string() + ": there is no such file or folder");
}

}  // namespace

std::vector<ComparedPair> compared_images(const CompareOptions& options) {
  check_exists(options.a);
  check_exists(options.b);
  const bool a_is_folder = fs::is_directory(options.a), b_is_folder = fs::is_directory(options.b);
  if (a_is_folder != b_is_folder) throw InputError("compare two images or two folders, not one of each");
  if (a_is_folder) return compared_folders(options);
  return {compared_files(options)};
}

}  // namespace billow::cli
