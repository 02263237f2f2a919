// run.json: what a run was, what it made, and what it cost.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/sudden_end.h"
#include "cli/run/film.h"
#include "cli/scene/scene.h"
#include "cli/scene/simulation.h"

namespace billow::cli {

/// What all pictures of a run share. Numbers read back to the bit.
nlohmann::ordered_json bounds_record(const render::RunBounds& bounds);
/// The bounds that the record of a run which has ended says, as those of this very scene, drawn by this version;
/// nothing where it says none.
std::optional<render::RunBounds> recorded_bounds(const nlohmann::json& record, const Scene& scene);

/// Puts into `report` what the record says of files that frames of states have no part in: strip, arrays and caches.
void add_made_before(const nlohmann::json& record, FilmReport& report);

/// The record of a run that has only begun, enough for --resume to know it by. `bounds` are those of the pictures that
/// are there, null where none are known.
nlohmann::ordered_json begun_record(const Run& run, const nlohmann::ordered_json& bounds);

/// The record of a run on its way, in a file. Whatever ends the process, the record says how it stands: "running" while
/// it does, then "failed" or "interrupted", even where the disk is full or memory has run out.
class RunningRecord {
 public:
  /// Writes it. Throws OutputError.
  RunningRecord(std::filesystem::path file, nlohmann::ordered_json begun);
  /// Says how the run ended, and why if there is a reason, unless another process has written its record there by now,
  /// as those may that draw frames of the same states: then it is false. What cannot be written does not throw: the run
  /// has failed already.
  bool end(SuddenEnd how, const std::string& reason) noexcept;

 private:
  std::filesystem::path file_;
  nlohmann::ordered_json begun_;
  std::optional<StandingMark> mark_;
};

/// Writes the record of a run that ended, whole, diverged or interrupted, to `file`: whole or not at all. Its times are
/// those of `progress` until now; what is `differing` stands in place of what it would say. Throws OutputError.
void write_finished_record(const std::filesystem::path& file, const Run& run, const Survey& survey,
                           const FilmReport& report, const Progress& progress, const nlohmann::ordered_json& differing);

}  // namespace billow::cli
