// PNG's bytes and OpenEXR's channels -> rows of numbers; two images' channels paired by name.
#include "render/image/image_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>

#include "base/error.h"
#include "base/srgb.h"
#include "render/image/exr_rows.h"
#include "render/image/png.h"

namespace billow::render {
namespace {

namespace fs = std::filesystem;

constexpr double bits16_of_bits8 = 257.0;  // 65535 / 255

bool is_exr(const fs::path& file) {
  std::error_code error;
  std::array<char, 4> head{};
  if (fs::is_regular_file(file, error)) std::ifstream(file, std::ios::binary).read(head.data(), head.size());
  if (head == std::array<char, 4>{'\x76', '\x2f', '\x31', '\x01'}) return true;
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".exr" && head[0] != '\x89';
}

bool is_colour(const std::string& name) { return name == "R" || name == "G" || name == "B" || name == "A"; }

int place_of(const std::vector<RowChannel>& channels, std::string_view name) {
  const auto found = std::find_if(channels.begin(), channels.end(), [&](const auto& c) { return c.name == name; });
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

void read_png_values(PngRows& rows, ValueRow& row) {
  const int channels = rows.channels(), bytes = rows.bits() / 8;
  const std::uint8_t* const first = rows.next();
  for (int c = 0; c < channels; ++c) {
    const std::uint8_t* value = first + bytes * c;
    for (int x = 0; x < rows.width(); ++x, value += bytes * channels)
      row(x, c) = bytes == 1 ? value[0] : 256 * value[0] + value[1];
  }
}

RowShape shape_of_png(const PngRows& rows) {
  RowShape shape{rows.width(), rows.height(), 0, 0, rows.bits() == 8 ? Depth::bits8 : Depth::bits16, {}};
  for (const char* name : {"R", "G", "B", "A"}) shape.channels.push_back({name});
  shape.channels.resize(static_cast<std::size_t>(rows.channels()));
  return shape;
}

// Names that only `some` has, but for alpha.
std::vector<std::string> names_beyond(const RowShape& some, const RowShape& other) {
  std::vector<std::string> names;
  for (const RowChannel& channel : some.channels)
    if (channel.name != "A" && place_of(other.channels, channel.name) < 0) names.push_back(channel.name);
  return names;
}

std::string alone(const std::vector<std::string>& names, const fs::path& file) {
  constexpr std::size_t most = 6;
  const std::vector<std::string> first(names.begin(), names.begin() + std::min(names.size(), most));
  return fmt::format("{} {}{} only in {}", names.size() == 1 ? "channel" : "channels", fmt::join(first, ", "),
                     names.size() > most ? fmt::format(" and {} more", names.size() - most) : "", file.string());
}

std::optional<std::string> mismatch_of(const RowShape& a, const RowShape& b, const fs::path& file_a,
                                       const fs::path& file_b) {
  if (a.width != b.width || a.height != b.height)
    return fmt::format("{} x {} and {} x {} pixels", a.width, a.height, b.width, b.height);
  if (a.left != b.left || a.top != b.top)
    return fmt::format("the pixels begin at ({}, {}) and ({}, {})", a.left, a.top, b.left, b.top);
  const std::vector<std::string> in_a = names_beyond(a, b), in_b = names_beyond(b, a);
  if (!in_a.empty()) return alone(in_a, file_a) + (in_b.empty() ? "" : "; " + alone(in_b, file_b));
  if (!in_b.empty()) return alone(in_b, file_b);
  return std::nullopt;
}

}  // namespace

std::string layer_of(const std::string& channel) {
  if (is_colour(channel)) return "colour";
  const std::size_t dot = channel.rfind('.');
  return dot == std::string::npos ? channel : channel.substr(0, dot);
}

std::optional<Eigen::Array3i> RowShape::colours() const {
  const Eigen::Array3i rgb(place_of(channels, "R"), place_of(channels, "G"), place_of(channels, "B"));
  if ((rgb >= 0).all()) return rgb;
  const int luminance = place_of(channels, "Y");
  if (luminance >= 0) return Eigen::Array3i::Constant(luminance);
  return std::nullopt;
}

double white_of(Depth depth) {
  switch (depth) {
    case Depth::bits8:
      return 255.0;
    case Depth::bits16:
      return 65535.0;
    case Depth::floats:
      return 1.0;
  }
  throw std::logic_error("a depth has no white");
}

ImageRows::ImageRows(const fs::path& file) {
  if (is_exr(file)) {
    const auto rows = std::make_shared<ExrRows>(file);
    shape_ = rows->shape();
    read_ = [rows](ValueRow& row) { rows->read(row); };
  } else {
    const auto rows = std::make_shared<PngRows>(file, PngDepth::own);
    shape_ = shape_of_png(*rows);
    read_ = [rows](ValueRow& row) { read_png_values(*rows, row); };
  }
  row_.resize(shape_.width, static_cast<Eigen::Index>(shape_.channels.size()));
}

const ValueRow& ImageRows::next() {
  read_(row_);
  return row_;
}

std::vector<std::uint8_t> seen_row(const RowShape& shape, const ValueRow& row) {
  std::vector<std::uint8_t> seen(3 * static_cast<std::size_t>(shape.width));
  const auto colours = shape.colours();
  if (!colours) return seen;
  const double of_255 = 255.0 / white_of(shape.depth);
  const auto encoded = [&](double value) {
    if (shape.depth != Depth::floats) return value * of_255;
    return std::isnan(value) ? 0.0 : 255.0 * linear_to_srgb(std::clamp(value, 0.0, 1.0));
  };
  for (int c = 0; c < 3; ++c)
    for (int x = 0; x < shape.width; ++x)  // rounded: it is not negative
      seen[3 * x + c] = static_cast<std::uint8_t>(std::lround(encoded(row(x, (*colours)(c)))));
  return seen;
}

ImagePair::ImagePair(const fs::path& a, const fs::path& b) : a_(a), b_(b) {
  const RowShape &shape_a = a_.rows.shape(), &shape_b = b_.rows.shape();
  if ((shape_a.depth == Depth::floats) != (shape_b.depth == Depth::floats))
    throw InputError(fmt::format("{} is {} and {} is {}: their values are not of one kind; convert one of them",
                                 a.string(), shape_a.depth == Depth::floats ? "OpenEXR" : "PNG", b.string(),
                                 shape_b.depth == Depth::floats ? "OpenEXR" : "PNG"));
  mismatch_ = mismatch_of(shape_a, shape_b, a, b);
  if (mismatch_) return;
  shape_ = shape_a;
  shape_.depth = std::max(shape_a.depth, shape_b.depth);
  if (place_of(shape_.channels, "A") < 0 && place_of(shape_b.channels, "A") >= 0) shape_.channels.push_back({"A"});
  for (RowChannel& channel : shape_.channels) {
    a_.source.push_back(place_of(shape_a.channels, channel.name));
    b_.source.push_back(place_of(shape_b.channels, channel.name));
    if (b_.source.back() >= 0) channel.meaning = std::max(channel.meaning, shape_b.channels[b_.source.back()].meaning);
  }
  if (shape_a.depth != shape_b.depth)
    note_ = fmt::format("{} against {} bits", shape_a.depth == Depth::bits8 ? 8 : 16,
                        shape_b.depth == Depth::bits8 ? 8 : 16);
}

void ImagePair::Side::next(const RowShape& shape) {
  const ValueRow& read = rows.next();
  const double factor = rows.shape().depth == shape.depth ? 1.0 : bits16_of_bits8;
  row.resize(shape.width, static_cast<Eigen::Index>(source.size()));
  for (std::size_t c = 0; c < source.size(); ++c)
    if (source[c] >= 0)
      row.col(static_cast<Eigen::Index>(c)) = factor * read.col(source[c]);
    else
      row.col(static_cast<Eigen::Index>(c)).setConstant(white_of(shape.depth));
}

void ImagePair::next() {
  a_.next(shape_);
  b_.next(shape_);
}

}  // namespace billow::render
