// Arrays of NumPy's that are written while they grow.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/spool.h"

namespace billow {

/// An array of `type` ("<f4", "<f8") whose first axis grows. What is appended waits in a spool; the file appears whole.
class NpyFile {
 public:
  NpyFile(std::filesystem::path file, std::string type)
      : file_(std::move(file)), type_(std::move(type)), spool_(file_) {}

  /// Numbers in the order in which the last axis runs fastest.
  void append(const void* numbers, std::size_t bytes);
  /// Throws OutputError when it cannot be written, std::logic_error when `shape` is not what was appended.
  void finish(const std::vector<long>& shape) const;

 private:
  std::filesystem::path file_;
  std::string type_;
  Spool spool_;
  std::size_t bytes_ = 0;
};

}  // namespace billow
