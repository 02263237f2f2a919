// The commands: each returns an exit status and throws what application.cpp turns into one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/words.h"
#include "cli/cluster/spread.h"
#include "cli/golden/image_tolerance.h"
#include "cli/run/render_scene.h"
#include "cli/scene/scene.h"
#include "render/gl/backend.h"

namespace CLI {
class App;
}

namespace billow::cli {

int render_command(const RenderOptions& options);
/// The frames of a scene as commands or jobs for other processes.
int spread_frames_command(const RenderOptions& options, const SpreadOptions& spread);

struct SceneOptions {
  std::filesystem::path scene;
  std::vector<Override> overrides;
  bool json = false;
  ProgressStyle progress = ProgressStyle::automatic;
};
int check_command(const SceneOptions& options);

struct MeshOptions {
  std::filesystem::path mesh;
  bool json = false;
};
int mesh_command(const MeshOptions& options);

int structure_command(const SceneOptions& options);

struct StabilityOptions {
  SceneOptions scene;
  bool measured = false;  // also bisect on whole non-linear runs: slow
  double time = 0.0;      // [s] linearise the state that the scene reaches then
};
int stability_command(const StabilityOptions& options);

struct FilterCommandOptions {
  SceneOptions scene;
  std::string body;              // whose waves; empty: the first
  std::filesystem::path output;  // empty: out/ and the scene's name with "-filter"
};
int filter_command(const FilterCommandOptions& options);

struct CompareOptions {
  std::filesystem::path a, b;
  std::filesystem::path difference;  // a file, or of two folders one; empty: none written
  std::filesystem::path report;      // folder of the page; empty: none written
  std::filesystem::path junit;       // JUnit's XML; empty: none written
  ImageTolerance tolerance;
  bool accept = false;                   // copy from B to A what differs or is new
  std::vector<std::string> accept_only;  // or of that these alone
  bool json = false;
};
int compare_command(const CompareOptions& options);

struct GoldenOptions {
  std::filesystem::path tests;
  std::filesystem::path output;           // empty: out/ and the name of the tests
  std::filesystem::path junit;            // JUnit's XML; empty: none written
  std::vector<std::string> only, update;  // patterns of names of tests and of pictures; empty: all, none
  std::string perform;                    // the pictures of this test alone, in this process, which is started for it
  bool list = false;                      // print the names of the tests and do nothing
  bool json = false;
  bool may_run_programs = false;  // that tests name
  render::Backend backend = {};   // that draws scenes
  bool untrusted = false;         // tests read no file outside of their folder, nor run programs
  int jobs = 0;                   // tests at a time; 0: one per core
};
int golden_command(const GoldenOptions& options);

struct StudyOptions {
  std::filesystem::path study;
  std::filesystem::path output;  // empty: out/ and the study's name
  bool list = false;             // print the runs and do nothing
  std::optional<int> only;       // this run alone, without assembling
  std::vector<FrameSpan> some;   // these runs, where they are unfinished, without assembling; empty: all
  std::optional<int> perform;    // this run alone, in this process, which has been started for it
  bool collect = false;          // assemble what is there, without running
  bool overwrite = false;        // run again what is finished
  int jobs = 0;                  // runs at a time; 0: one per core, or one where runs are timed
  int threads = 0;               // of a run; 0: one per core
  bool resume = false;           // runs keep their states while they go on
  SpreadOptions spread;          // for other processes to do, instead
  bool untrusted = false;        // runs read no file outside of the study's folder either
  render::Backend backend = {};  // that draws its runs
};
int study_command(const StudyOptions& options);

struct VideoOptions {
  std::filesystem::path folder;  // of a run
  std::string views;             // side by side, comma-separated; empty: the run's first
  std::filesystem::path output;  // empty: in the folder, named by the views
  double fps = 0.0;              // 0: the run's
  bool overwrite = false;
  ProgressStyle progress = ProgressStyle::automatic;
};
int video_command(const VideoOptions& options);

struct SheetOptions {
  std::filesystem::path folder;  // of a run
  std::string views;             // comma-separated; empty: the run's first
  std::filesystem::path output;  // empty: in the folder, named by the views
  int count = 12;                // frames
  int columns = 0;               // frames a row; 0: about as many as there are rows
  bool overwrite = false;
};
int sheet_command(const SheetOptions& options);

int doctor_command();

/// What is written of the command line itself.
enum class Generated { man, bash, zsh, fish };
Words<Generated> words(Generated);
int generate_command(Generated what, const CLI::App& program);

}  // namespace billow::cli
