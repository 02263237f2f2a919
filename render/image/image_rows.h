// Images of any kind, read row by row as numbers.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace billow::render {

/// How an image keeps its values: 0 to 255, 0 to 65535, or numbers in units of their own.
enum class Depth { bits8, bits16, floats };

/// What the values of a channel are: quantities, or identities, of which two are the same or they are not. A hash is
/// the bits of a 32-bit float, as Cryptomatte has it.
enum class Meaning { quantity, number, hash };

struct RowChannel {
  std::string name;  // R, G, B, A, or as OpenEXR has it: LAYER.COMPONENT
  Meaning meaning = Meaning::quantity;

  bool exact() const { return meaning != Meaning::quantity; }
};

/// "LAYER" of LAYER.COMPONENT, "colour" of R, G, B and A, else the channel itself.
std::string layer_of(const std::string& channel);

/// What is known of an image before its rows.
struct RowShape {
  int width = 0, height = 0;
  int left = 0, top = 0;  // where its pixels begin in the whole picture: 0 but for some OpenEXR files
  Depth depth = Depth::bits8;
  std::vector<RowChannel> channels;

  /// The channels that are red, green and blue of what is seen; nothing where there are no colours. One channel of
  /// luminance, Y, is all three.
  std::optional<Eigen::Array3i> colours() const;
};

/// A row of values, a column for each channel.
using ValueRow = Eigen::ArrayXXd;  // (width x channels)

/// The largest value of a depth; 1 for floats, which is white.
double white_of(Depth depth);

/// An OpenEXR or PNG image, told by its first bytes, from the top. PNG images have R, G and B and, where they are
/// transparent anywhere, A.
class ImageRows {
 public:
  /// Throws InputError as PngRows or ExrRows.
  explicit ImageRows(const std::filesystem::path& file);
  const RowShape& shape() const { return shape_; }
  /// The next row, which stays until the next call. Throws InputError where the file is damaged.
  const ValueRow& next();

 private:
  RowShape shape_;
  std::function<void(ValueRow&)> read_;
  ValueRow row_;
};

/// What is seen of a row, red, green and blue next to one another: floats are clamped to [0, 1] and encoded as sRGB.
/// All 0 where the shape has no colours.
std::vector<std::uint8_t> seen_row(const RowShape& shape, const ValueRow& row);

/// Two images of one size and of the same channels read side by side, on one scale: 8-bit values against those of 16
/// bits become such. A channel A that one lacks is opaque.
class ImagePair {
 public:
  /// Throws InputError as ImageRows, and where one image is PNG and the other OpenEXR.
  ImagePair(const std::filesystem::path& a, const std::filesystem::path& b);
  /// Why there is no value of the one for each of the other: they differ in size or in channels. Nothing where there
  /// is.
  const std::optional<std::string>& mismatch() const { return mismatch_; }
  /// What is odd about the two, to be said beside their differences; most often empty.
  const std::string& note() const { return note_; }
  /// Of both; only where nothing is amiss.
  const RowShape& shape() const { return shape_; }
  /// The next of shape().height rows. Throws InputError where a file is damaged.
  void next();
  const ValueRow& a() const { return a_.row; }
  const ValueRow& b() const { return b_.row; }

 private:
  struct Side {
    explicit Side(const std::filesystem::path& file) : rows(file) {}
    void next(const RowShape& shape);

    ImageRows rows;
    std::vector<int> source;  // of each channel of both: its place here, or -1
    ValueRow row;
  };

  Side a_, b_;
  RowShape shape_;
  std::optional<std::string> mismatch_;
  std::string note_;
};

}  // namespace billow::render
