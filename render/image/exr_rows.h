// OpenEXR files in, row by row.
#pragma once

#include <filesystem>
#include <memory>

#include "render/image/image_rows.h"

namespace billow::render {

/// The channels of an OpenEXR file as numbers, from the top: half, float and unsigned values, of scan lines or tiles
/// (the finest level), however they are packed, of one part or several of one data window, whose channels have their
/// part's name before them where another has the same. Unsigned values and Cryptomatte's identities are exact. Holds no
/// more than the rows that are packed together.
class ExrRows {
 public:
  /// Throws InputError on a file that is missing, no regular file, damaged, deep, subsampled, larger than 8192 x 8192
  /// or of more than 256 channels.
  explicit ExrRows(const std::filesystem::path& file);
  ~ExrRows();
  const RowShape& shape() const;
  /// The next of shape().height rows. Throws InputError where the file is damaged.
  void read(ValueRow& row);

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace billow::render
