// Making, checking and clearing a run's folder.
#include "cli/run/output_folder.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/error.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

bool is_empty_or_missing(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return true;
  if (!fs::is_directory(folder, error))
    throw OutputError(fmt::format("{} is not a folder; choose another with -o", folder.string()));
  return fs::directory_iterator(folder, error) == fs::directory_iterator();
}

bool is_frame(const fs::path& file, std::string_view extension) {
  const std::string stem = file.stem().string();
  return file.extension() == extension && stem.starts_with("frame_") && stem.size() > 6 &&
         stem.find_first_not_of("0123456789", 6) == std::string::npos;
}

void remove_earlier_run(const fs::path& folder) {
  std::error_code error;
  for (const render::ViewRow& view : render::views()) {
    std::vector<fs::path> frames;
    for (const auto& entry : fs::directory_iterator(folder / view.folder, error))
      if (entry.is_regular_file(error) && is_frame(entry.path(), view.extension)) frames.push_back(entry.path());
    for (const fs::path& frame : frames) fs::remove(frame, error);
    if (fs::is_directory(folder / view.folder, error))
      fs::remove(folder / view.folder, error);  // only if it is empty now
  }
  for (const std::string_view file : all_words<RunFile>())
    if (fs::is_regular_file(folder / file, error)) fs::remove(folder / file, error);
}

// The scene hash that a run's record names; empty where there is no such record.
std::string hash_in(const fs::path& record) {
  std::error_code error;
  if (!fs::is_regular_file(record, error)) return "";
  std::ifstream file(record);
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  const nlohmann::json::json_pointer place("/scene/hash");
  return json.is_object() && json.contains(place) && json[place].is_string() ? json[place].get<std::string>() : "";
}

void check_same_run(const fs::path& record, const std::string& scene_hash) {
  if (hash_in(record) == scene_hash) return;
  throw OutputError(fmt::format("{} is not of this scene, so its run cannot be resumed; use --overwrite to replace it",
                                record.string()));
}

}  // namespace

// Their names.
Words<RunFile> words(RunFile) {
  static constexpr Word<RunFile> list[] = {{"velocity_strip.png", RunFile::strip},
                                           {"velocity_image.png", RunFile::velocity_image},
                                           {"velocity_spectrum.png", RunFile::spectrum},
                                           {"spectrum.csv", RunFile::spectrum_table},
                                           {"run.json", RunFile::record},
                                           {"index.html", RunFile::page}};
  return list;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
}

void check_output_folder(const fs::path& folder, Existing existing, const std::string& scene_hash) {
  const bool empty = is_empty_or_missing(folder);
  if (!empty && existing == Existing::refuse)
    throw OutputError(
        fmt::format("{} already holds files; use --overwrite to replace a run there, --resume to finish "
                    "it, or -o for another folder",
                    folder.string()));
  if (!empty && existing == Existing::resume) check_same_run(folder / "run.json", scene_hash);
}

OutputFolder::OutputFolder(fs::path folder, Existing existing, const std::string& scene_hash,
                           const std::vector<render::View>& views)
    : folder_(std::move(folder)), views_(views), existing_(existing) {
  check_output_folder(folder_, existing, scene_hash);
  make_folder(folder_);
}

void OutputFolder::begin_run() {
  if (existing_ == Existing::overwrite) remove_earlier_run(folder_);
  for (const render::View view : views_) make_folder(folder_ / render::folder(view));
}

fs::path OutputFolder::frame(render::View view, long frame) const {
  return folder_ / render::folder(view) / fmt::format("frame_{:04}{}", frame, render::row_of(view).extension);
}

fs::path OutputFolder::file(RunFile file) const { return folder_ / word_of(file); }

bool OutputFolder::keeps(render::View view, long number) const {
  std::error_code error;
  const fs::path file = frame(view, number);
  return existing_ == Existing::resume && fs::is_regular_file(file, error) && fs::file_size(file, error) > 0;
}

}  // namespace billow::cli
