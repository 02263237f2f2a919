// One run of a study: a scene rendered, measured or timed.
#pragma once

#include <filesystem>
#include <string>

#include "cli/scene/scene.h"
#include "cli/study/study.h"
#include "cli/study/study_results.h"
#include "render/gl/backend.h"

namespace billow::cli {

/// What a finished run must carry to count as this one: everything that its result depends on.
std::string run_hash(const Study& study, const Scene& scene);

/// "billow render scenes/drape.yaml -D solver.method=rk4": the run by hand.
std::string command_of(const Study& study, const StudyRun& run);

/// How a run is gone about; its result does not depend on it.
struct RunConduct {
  int threads = 0;               // 0: one per core
  bool keep_states = false;      // of its film, until that is whole
  render::Backend backend = {};  // that draws its film
};

/// Does what the study's measures ask for, in `folder`, and writes result.json there, unless a signal asks for the end.
/// A divergence is a result. Where an earlier process was stopped and has kept states of its film, goes on from there.
/// Throws InputError on a bad scene, OutputError.
RunResult perform_run(const Study& study, const StudyRun& run, const std::filesystem::path& folder,
                      const RunConduct& conduct);

}  // namespace billow::cli
