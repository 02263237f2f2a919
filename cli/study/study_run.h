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

/// Does what the study's measures ask for, in `folder`, and writes result.json there; `backend` draws what is drawn. A
/// divergence is a result. Throws InputError on a bad scene, OutputError.
RunResult perform_run(const Study& study, const StudyRun& run, const std::filesystem::path& folder,
                      const render::Backend& backend);

}  // namespace billow::cli
