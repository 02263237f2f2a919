// Two images, or two folders of images, judged pair by pair.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/command/commands.h"
#include "render/image/compare.h"

namespace billow::cli {

/// How a pair of images came out.
enum class Verdict { same, different, unreadable };

struct ComparedPair {
  std::string name;  // of both: relative to the folders, or of the files
  std::filesystem::path a, b;
  Verdict verdict = Verdict::unreadable;
  std::string why;                               // in a line
  std::optional<render::Comparison> comparison;  // where both could be read and are of one size
};

/// Every pair of images of two files or of two folders (below them, *.png in any case), by name. What befalls a pair is
/// in its row and stops no other; a file that is in one folder only is a difference. Throws InputError where there is
/// nothing to compare at all.
std::vector<ComparedPair> compared_images(const CompareOptions& options);

}  // namespace billow::cli
