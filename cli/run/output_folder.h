// Where a run's files go, and what may already be there.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/words.h"
#include "cli/scene/scene.h"
#include "render/image/settings.h"

namespace billow::cli {

/// What to do with a folder that already holds something.
enum class Existing { refuse, overwrite, resume };

/// Makes the folder and those above it where they are missing. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

/// Makes `inner`, a relative path, within a folder that is there. Throws OutputError also where a folder on the way is
/// a link: what the tool writes stays in the folder that it was given.
void make_folder_within(const std::filesystem::path& folder, const std::filesystem::path& inner);

/// Throws OutputError when `folder` holds anything and `existing` is refuse, or holds anything but a run of this scene,
/// however long, by its run.json and it is resume, or when a folder in it that a run writes to is a link. Folders in
/// which there is nothing, and the temporary files of runs that were killed, count as nothing. Changes nothing.
void check_output_folder(const std::filesystem::path& folder, Existing existing, const Scene& scene);

/// Whether run.json of `folder` is of this very scene.
bool is_of_scene(const std::filesystem::path& folder, const Scene& scene);

/// run.json of `folder`, as far as it can be read; null where it cannot.
nlohmann::json earlier_record(const std::filesystem::path& folder);

/// The files of a run besides its frames.
enum class RunFile {
  strip,
  strip_array,
  velocity_image,
  velocity_image_array,
  spectrum,
  spectrum_array,
  spectrum_table,
  frame_table,
  glb,
  glb_script,
  record,
  page
};
Words<RunFile> words(RunFile);

/// The file of a frame in a run's folder.
std::filesystem::path frame_of(const std::filesystem::path& folder, render::View view, long frame);

/// DIR of `billow render`: a folder of frames for each view, and the run's files.
class OutputFolder {
 public:
  /// Makes the folder. Throws OutputError as check_output_folder, or when it cannot be made.
  OutputFolder(std::filesystem::path folder, Existing existing, const Scene& scene,
               const std::vector<render::View>& views);

  /// Call it when the first frame is about to be drawn and the run's own record stands: `overwrite` now removes what
  /// else an earlier run wrote there, and nothing else but the temporary files of runs that were killed; nothing
  /// through a link, and nothing at all where there was no run. The second call does nothing.
  void begin_run();
  /// The same where other processes may be drawing other frames of the run: removes nothing else.
  void join_run();
  /// Draw everything again, also what is there.
  void keep_nothing() { keeps_ = false; }
  /// Removes the frames of all views.
  void remove_frames() const;

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path frame(render::View view, long frame) const;
  std::filesystem::path file(RunFile file) const;
  /// Where states are kept (state_store.h).
  std::filesystem::path states() const;
  /// The frames of 1 to `total` that are there in every view, ascending.
  std::vector<long> frames_drawn(long total) const;
  /// The folder of geometry caches; it need not be there.
  std::filesystem::path caches() const;
  /// True when resuming and there is a file of the frame, whole or not.
  bool keeps(render::View view, long frame) const;

 private:
  std::filesystem::path folder_;
  std::vector<render::View> views_;
  bool keeps_;
  bool replaces_;  // an earlier run, which begin_run() removes
};

}  // namespace billow::cli
