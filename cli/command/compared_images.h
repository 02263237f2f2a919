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

/// As tables have it.
const char* name_of(Verdict verdict);

struct ComparedPair {
  std::string name;  // of both: relative to the folders, or of the files
  std::filesystem::path a, b;
  Verdict verdict = Verdict::unreadable;
  std::string why;                               // in a line
  std::string reason;                            // for another tolerance than the usual one; empty: it is that
  std::optional<render::Comparison> comparison;  // where both could be read and are of one size
};

/// Every pair of images of two files or of two folders (below them, *.png in any case), by name. What befalls a pair is
/// in its row and stops no other; a file that is in one folder only is a difference. In the first folder NAME.1.png and
/// so on are other pictures that will do for NAME.png, where the second has no such files, and NAME.tolerance.yaml is
/// the tolerance of NAME.png. Throws InputError where there is nothing to compare at all.
std::vector<ComparedPair> compared_images(const CompareOptions& options);

/// Copies from the second folder, or file, to the first those of `pairs` that differ or are new there, of
/// options.accept_only if that names any, each whole or not at all, and nothing else. Their verdict becomes `same`. The
/// names of what was copied. Throws InputError for a name that is none of theirs, OutputError, and InputError too where
/// the environment variable CI is set: a machine must not accept.
std::vector<std::string> accept(std::vector<ComparedPair>& pairs, const CompareOptions& options);

}  // namespace billow::cli
