// How two images are compared and when they are the same: by options, by a file beside a baseline, and by a test.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "cli/yaml/yaml_reader.h"
#include "render/image/compare.h"

namespace billow::cli {

/// In the place of a baseline's extension: the file with its tolerance.
inline constexpr std::string_view tolerance_ending = ".tolerance.yaml";

struct ImageTolerance {
  render::ComparisonOptions what;
  render::Tolerance allowed;
  std::filesystem::path mask;  // empty: every pixel counts
  std::string reason;          // why it is not the usual one; empty: it is
};

/// "250" pixels or "0.5%" of them; false for anything else.
bool read_pixels(const std::string& text, render::Tolerance& tolerance);

/// "3", "0.5" of 255, or "0.1%" of white; false for anything else and what is more than white.
bool read_share_of_white(const std::string& text, double& of_255);

/// The keys of a tolerance, and of its metrics.
const Section& tolerance_keys();
const Section& metric_keys();

/// When a tolerance must say why it is what it is.
enum class ReasonFor { anything, what_is_not_stricter };

/// `usual`, but for what a map says; its mask is relative to `folder`. Throws InputError with the place of what is
/// wrong in it.
ImageTolerance read_tolerance(const Node& node, const std::filesystem::path& folder, const ImageTolerance& usual,
                              ReasonFor reason);

/// `usual`, but for what NAME.tolerance.yaml beside the baseline NAME.png or NAME.exr says, if there is one. Throws
/// InputError with the place of what is wrong in it.
ImageTolerance tolerance_of(const std::filesystem::path& baseline, const ImageTolerance& usual);

}  // namespace billow::cli
