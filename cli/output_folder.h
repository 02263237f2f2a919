// Where a run's files go, and what may already be there.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "render/settings.h"

namespace billow::cli {

/// What to do with a folder that already holds something.
enum class Existing { refuse, overwrite, resume };

/// Makes the folder and those above it where they are missing. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

/// Throws OutputError when `folder` holds anything and `existing` is refuse, or holds anything but a run whose run.json
/// names `scene_hash` and it is resume. Changes nothing.
void check_output_folder(const std::filesystem::path& folder, Existing existing, const std::string& scene_hash);

/// DIR of `billow render`: textured/, velocity/, velocity_strip.png, run.json, index.html; with a spectrum also
/// velocity_image.png, velocity_spectrum.png, spectrum.csv.
class OutputFolder {
 public:
  /// Makes the folder. Throws OutputError as check_output_folder, or when it cannot be made.
  OutputFolder(std::filesystem::path folder, Existing existing, const std::string& scene_hash,
               const std::vector<render::View>& views);

  /// Call it when the first frame is about to be drawn: `overwrite` now removes the frames, strip, record and page that
  /// an earlier run wrote there, and nothing else.
  void begin_run();

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path frame(render::View view, long frame) const;
  std::filesystem::path strip() const { return folder_ / "velocity_strip.png"; }
  std::filesystem::path velocity_image() const { return folder_ / "velocity_image.png"; }
  std::filesystem::path spectrum() const { return folder_ / "velocity_spectrum.png"; }
  std::filesystem::path spectrum_table() const { return folder_ / "spectrum.csv"; }
  std::filesystem::path record() const { return folder_ / "run.json"; }
  std::filesystem::path page() const { return folder_ / "index.html"; }
  /// True when resuming and the frame is there already.
  bool keeps(render::View view, long frame) const;

 private:
  std::filesystem::path folder_;
  std::vector<render::View> views_;
  Existing existing_;
};

/// The view's name, also of its folder.
std::string_view name(render::View view);

}  // namespace billow::cli
