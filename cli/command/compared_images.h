// Two images, or two folders of images, judged pair by pair.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
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
  std::optional<render::Comparison> comparison;  // where both could be read and have a value for each of the other's
  std::string note = {};                         // what of `why` is worth saying of those that are the same too
};

/// Every pair of images of two files or of two folders (below them, *.png and *.exr in any case), by name. What befalls
/// a pair is in its row and stops no other; a file that is in one folder only is a difference; links to folders are not
/// followed, which is said in a row. In the first folder NAME.1.png and so on are other pictures that will do for
/// NAME.png, where the second has no such names, NAME.tolerance.yaml is the tolerance of NAME.png (so with NAME.exr),
/// and masks that these name are no pictures. Throws InputError where there is nothing to compare at all.
std::vector<ComparedPair> compared_images(const CompareOptions& options);
/// The same of two folders, either of which need not be there.
std::vector<ComparedPair> compared_folders(const CompareOptions& options);
/// The pair of that name in two folders, either of which need not have it.
ComparedPair compared_picture(const std::string& name, const CompareOptions& options);

/// Throws InputError where the environment variable CI is set: a machine must not accept. `option` asked for it.
void check_may_accept(std::string_view option);

/// Whether its picture may become the baseline: it can be read, and it differs, or there is no baseline that can be.
/// Where both can be read and nobody could judge them, as by a tolerance that is at fault, that is what to mend.
bool can_be_accepted(const ComparedPair& pair);

/// Copies from the second folder, or file, to the first those of `pairs` that differ, are new there or damaged there,
/// and are whole images in the second; all, or those of options.accept_only; each whole or not at all, none through a
/// link. Their verdict becomes `same`. The names of what was copied. Throws as
/// check_may_accept, InputError where options.accept_only names what is not to be had, OutputError, which says what was
/// copied before.
std::vector<std::string> accept(std::vector<ComparedPair>& pairs, const CompareOptions& options);

}  // namespace billow::cli
