// Where a run's files go, and what may already be there.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/words.h"
#include "render/image/settings.h"

namespace billow::cli {

/// What to do with a folder that already holds something.
enum class Existing { refuse, overwrite, resume };

/// Makes the folder and those above it where they are missing. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

/// Throws OutputError when `folder` holds anything and `existing` is refuse, or holds anything but a run whose run.json
/// names `scene_hash` and it is resume. Changes nothing.
void check_output_folder(const std::filesystem::path& folder, Existing existing, const std::string& scene_hash);

/// The files of a run besides its frames.
enum class RunFile { strip, velocity_image, spectrum, spectrum_table, record, page };
Words<RunFile> words(RunFile);

/// The file of a frame in a run's folder.
std::filesystem::path frame_of(const std::filesystem::path& folder, render::View view, long frame);

/// DIR of `billow render`: a folder of frames for each view, and the run's files.
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
  std::filesystem::path file(RunFile file) const;
  /// True when resuming and the frame is there already.
  bool keeps(render::View view, long frame) const;

 private:
  std::filesystem::path folder_;
  std::vector<render::View> views_;
  Existing existing_;
};

}  // namespace billow::cli
