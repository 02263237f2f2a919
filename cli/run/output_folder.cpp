// Making, checking and clearing a run's folder.
#include "cli/run/output_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/run/state_store.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view caches_name = "caches";

bool holds_anything(const fs::path& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (!entry->is_directory(error) && !is_temporary_name(entry->path().filename().native())) return true;
  return static_cast<bool>(error);
}

bool is_empty_or_missing(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return true;
  if (!fs::is_directory(folder, error))
    throw OutputError(fmt::format("{} is not a folder; choose another with -o", folder.string()));
  return !holds_anything(folder);
}

bool has_extension(const fs::path& file, std::initializer_list<std::string_view> extensions) {
  return std::find(extensions.begin(), extensions.end(), file.extension().string()) != extensions.end();
}

bool is_frame(const fs::path& file) {
  const std::string stem = file.stem().string();
  return has_extension(file, {".png", ".obj", ".ply", ".vtp", ".exr"}) && stem.starts_with("frame_") &&
         stem.size() > 6 && stem.find_first_not_of("0123456789", 6) == std::string::npos;
}

bool is_cache(const fs::path& file) {
  return has_extension(file, {".pc2", ".mdd", ".pvd", ".glb"}) || file.filename().string().ends_with(".rest.obj");
}

bool is_link(const fs::path& path) {
  std::error_code error;
  return fs::is_symlink(fs::symlink_status(path, error));
}

[[noreturn]] void refuse_link(const fs::path& folder) {
  throw OutputError(fmt::format(
      "{} is a link, and nothing is written through it; remove it, or choose another folder with -o", folder.string()));
}

// Where runs write to, besides what is in these.
std::vector<fs::path> folders_of_runs(const fs::path& folder) {
  std::vector<fs::path> folders = {folder / caches_name, folder / StateStore::folder_name};
  for (const render::ViewRow& view : render::views()) folders.push_back(folder / view.folder);
  return folders;
}

// Removes the files in `folder` that are ours, and the folder if nothing else is in it. Throws OutputError for a file
// that stays: it would be taken for one of the run that comes.
void remove_files(const fs::path& folder, bool (*is_ours)(const fs::path&)) {
  if (is_link(folder)) return;
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_regular_file(error) && is_ours(entry.path())) files.push_back(entry.path());
  for (const fs::path& file : files) {
    fs::remove(file, error);
    if (error) throw OutputError(fmt::format("cannot remove {}: {}", file.string(), error.message()));
  }
  if (fs::is_directory(folder, error)) fs::remove(folder, error);  // only if it is empty now
}

void remove_caches(const fs::path& folder) {
  if (is_link(folder)) return;
  std::error_code error;
  std::vector<fs::path> sequences;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory(error)) sequences.push_back(entry.path());
  for (const fs::path& sequence : sequences) remove_files(sequence, is_frame);
  remove_files(folder, is_cache);
}

// The folders of a run: itself, those of its views, its states, its caches and their sequences.
void remove_strays_of_runs(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> folders = folders_of_runs(folder);
  folders.push_back(folder);
  for (fs::directory_iterator entry(folder / caches_name, error), end; !error && entry != end; entry.increment(error))
    if (entry->is_directory(error)) folders.push_back(entry->path());
  for (const fs::path& each : folders)
    if (!is_link(each)) remove_strays(each);
}

void remove_all_frames(const fs::path& folder) {
  for (const render::ViewRow& view : render::views()) remove_files(folder / view.folder, is_frame);
}

void remove_earlier_run(const fs::path& folder) {
  std::error_code error;
  remove_all_frames(folder);
  remove_caches(folder / caches_name);
  if (const fs::path states = folder / StateStore::folder_name; !is_link(states)) remove_states(states);
  for (const auto& [name, kind] : words(RunFile()))
    if (const fs::path file = folder / name;
        kind != RunFile::record && fs::is_regular_file(file, error) && !is_link(folder / *fs::path(name).begin()))
      fs::remove(file, error);
  if (fs::is_directory(folder / caches_name, error))
    fs::remove(folder / caches_name, error);  // only if it is empty now
}

// Of the same scene, or of one that only ends at another time.
bool is_same_run(const fs::path& folder, const Scene& scene) {
  const nlohmann::json record = earlier_record(folder);
  const nlohmann::json::json_pointer whole("/scene/hash"), timeless("/scene/timeless_hash");
  return record.is_object() &&
         (record.value(whole, "") == scene.hash || record.value(timeless, "") == scene.timeless_hash);
}

void check_same_run(const fs::path& folder, const Scene& scene) {
  if (is_same_run(folder, scene)) return;
  if (std::error_code error; !fs::exists(folder / word_of(RunFile::record), error))
    throw OutputError(
        fmt::format("{} holds files but no run.json, so there is no run to resume; use --overwrite to write into it "
                    "all the same, or -o for "
                    "another folder",
                    folder.string()));
  throw OutputError(fmt::format(
      "{} is not of this scene, so its run cannot be gone on with; choose another folder with -o, or replace "
      "the run with --overwrite, without --resume, --from and --slurm",
      (folder / "run.json").string()));
}

}  // namespace

// Their names.
Words<RunFile> words(RunFile) {
  static constexpr Word<RunFile> list[] = {{"velocity_strip.png", RunFile::strip},
                                           {"velocity_strip.npy", RunFile::strip_array},
                                           {"velocity_image.png", RunFile::velocity_image},
                                           {"velocity_image.npy", RunFile::velocity_image_array},
                                           {"velocity_spectrum.png", RunFile::spectrum},
                                           {"velocity_spectrum.npy", RunFile::spectrum_array},
                                           {"spectrum.csv", RunFile::spectrum_table},
                                           {"frames.csv", RunFile::frame_table},
                                           {"caches/scene.glb", RunFile::glb},
                                           {"caches/scene.glb.js", RunFile::glb_script},
                                           {"run.json", RunFile::record},
                                           {"index.html", RunFile::page}};
  return list;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return;
  const bool forbidden = error == std::errc::permission_denied || error == std::errc::operation_not_permitted ||
                         error == std::errc::read_only_file_system;
  throw OutputError(fmt::format("cannot make the folder {}: {}{}", fs::absolute(folder).string(), error.message(),
                                forbidden ? "; name one where you may write" : ""));
}

void make_folder_within(const fs::path& folder, const fs::path& inner) {
  fs::path made = folder;
  for (const fs::path& name : inner) {
    made /= name;
    if (is_link(made)) refuse_link(made);
    make_folder(made);
  }
}

nlohmann::json earlier_record(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(folder / "run.json", error)) return {};
  std::ifstream file(folder / "run.json");
  nlohmann::json record = nlohmann::json::parse(file, nullptr, false);
  const nlohmann::json::json_pointer whole("/scene/hash"), timeless("/scene/timeless_hash");
  const bool is_record = record.is_object() && record.value(whole, nlohmann::json()).is_string() &&
                         record.value(timeless, nlohmann::json()).is_string();
  return is_record ? record : nlohmann::json();
}

bool is_of_scene(const fs::path& folder, const Scene& scene) {
  const nlohmann::json record = earlier_record(folder);
  return record.is_object() && record.value(nlohmann::json::json_pointer("/scene/hash"), "") == scene.hash;
}

void check_output_folder(const fs::path& folder, Existing existing, const Scene& scene) {
  const bool empty = is_empty_or_missing(folder);
  if (!empty && existing == Existing::refuse)
    throw OutputError(
        fmt::format("{} already holds files; use --overwrite to replace a run there, --resume to finish "
                    "it, or -o for another folder",
                    folder.string()));
  for (const fs::path& inner : folders_of_runs(folder))
    if (is_link(inner)) refuse_link(inner);
  if (!empty && existing == Existing::resume) check_same_run(folder, scene);
}

OutputFolder::OutputFolder(fs::path folder, Existing existing, const Scene& scene,
                           const std::vector<render::View>& views)
    : folder_(std::move(folder)),
      views_(views),
      keeps_(existing == Existing::resume),
      replaces_(existing == Existing::overwrite && fs::exists(folder_ / word_of(RunFile::record))) {
  check_output_folder(folder_, existing, scene);
  make_folder(folder_);
}

void OutputFolder::begin_run() {
  if (std::exchange(replaces_, false)) remove_earlier_run(folder_);
  join_run();
}

void OutputFolder::join_run() {
  for (const render::View view : views_) make_folder_within(folder_, render::folder(view));
  remove_strays_of_runs(folder_);
}

fs::path frame_of(const fs::path& folder, render::View view, long frame) {
  return folder / render::folder(view) / fmt::format("frame_{:04}{}", frame, render::row_of(view).extension);
}

fs::path OutputFolder::frame(render::View view, long frame) const { return frame_of(folder_, view, frame); }

fs::path OutputFolder::states() const { return folder_ / StateStore::folder_name; }

fs::path OutputFolder::caches() const { return folder_ / caches_name; }

fs::path OutputFolder::file(RunFile file) const { return folder_ / word_of(file); }

void OutputFolder::remove_frames() const { remove_all_frames(folder_); }

std::vector<long> OutputFolder::frames_drawn(long total) const {
  std::error_code error;
  std::vector<long> drawn;
  for (long number = 1; number <= total; ++number)
    if (std::all_of(views_.begin(), views_.end(),
                    [&](render::View view) { return fs::is_regular_file(frame(view, number), error); }))
      drawn.push_back(number);
  return drawn;
}

bool OutputFolder::keeps(render::View view, long number) const {
  std::error_code error;
  return keeps_ && fs::is_regular_file(frame(view, number), error);
}

}  // namespace billow::cli
