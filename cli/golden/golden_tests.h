// A validated file of tests: where pictures come from, and how they are compared with their baselines.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/words.h"
#include "cli/golden/image_tolerance.h"
#include "cli/run/frame_list.h"
#include "cli/yaml/yaml_overrides.h"
#include "render/image/views.h"

namespace billow::cli {

/// What of a run is compared: frames of its views, a contact sheet of each view, and the pictures of the whole run.
enum class RunPicture { frames, sheet, strip, velocity_image, spectrum };
Words<RunPicture> words(RunPicture);

/// Pictures of a scene, which the test renders.
struct RenderedPictures {
  std::filesystem::path scene;
  std::vector<Override> changes;
  std::vector<FrameSpan> frames;    // empty: all
  std::vector<render::View> views;  // empty: the scene's
  std::vector<RunPicture> kinds;    // at least one
  std::string frames_where, kinds_where;
};

/// Pictures that are in a folder already, whatever made them.
struct FoundPictures {
  std::filesystem::path folder;
};

/// Pictures that a program makes.
struct MadePictures {
  /// What stands in its arguments for the folder that it has to write to.
  static constexpr std::string_view output_mark = "{output}";

  std::vector<std::string> command;  // at least one word, none of them read by a shell
  int timeout = 0;                   // [s]
};

struct GoldenTest {
  std::string name;  // of its folder of baselines
  std::variant<RenderedPictures, FoundPictures, MadePictures> pictures;
  ImageTolerance tolerance;
};

struct GoldenTests {
  std::filesystem::path file;
  std::filesystem::path baselines;  // a folder of folders, one a test
  ImageTolerance tolerance;         // of tests that say nothing else
  std::vector<GoldenTest> tests;    // at least one, their names unique on every file system
};

/// Reads and checks a file of tests; scenes are checked when they are rendered. Throws InputError
/// "FILE:LINE:COLUMN: …".
GoldenTests read_golden_tests(const std::filesystem::path& file);

}  // namespace billow::cli
