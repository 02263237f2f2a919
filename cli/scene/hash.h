// A short fingerprint of what went into a run. It finds changes, it does not resist forgery.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace billow::cli {

/// FNV-1a over 64 bits. Every part brings its length along, so that no two lists of parts run together.
class Hash {
 public:
  void add(std::string_view bytes);
  /// Throws InputError when the file cannot be read.
  void add_file(const std::filesystem::path& file);
  /// 16 hex digits.
  std::string hex() const;

 private:
  void mix(std::string_view bytes);
  void mix_length(std::uint64_t length);

  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace billow::cli
