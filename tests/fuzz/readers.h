// Everything in billow that reads bytes which somebody else may have written, one function each.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace billow::test {

struct FuzzReader {
  std::string_view name;
  /// Reads `bytes`, laid as a file into a furnished folder where they have to be one. Whatever they are, it returns or
  /// throws InputError.
  void (*read)(std::string_view bytes, const std::filesystem::path& folder);
};

std::span<const FuzzReader> fuzz_readers();

/// The reader of that name, or null.
const FuzzReader* find_fuzz_reader(std::string_view name);

/// Lays into an empty folder what inputs refer to: the shipped scenes, and beside their folder `assets` and, as
/// `corpus`, the small meshes of tests/corpus/files.
void furnish_fuzz_folder(const std::filesystem::path& folder);

}  // namespace billow::test
