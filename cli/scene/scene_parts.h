// The parts of a scene file, each read by a file of its own. Reading needs no other file; loading does, so that every
// fault of the YAML is found before the first mesh is opened.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/scene/scene.h"
#include "cli/yaml/yaml_reader.h"
#include "sim/mesh/selection.h"

namespace billow::cli {

/// Runs `work` and puts the place in the scene before whatever it finds wrong.
template <class Work>
auto located(const std::string& where, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    fail_at(where, error.what());
  }
}

/// What a pin says and where.
struct PinDraft {
  sim::Selector selector;
  std::string where;
};

/// A formula over a body's particles (particle_expression.h), and where it stands.
struct FormulaDraft {
  std::string text = "1", where;
};

/// A body as the YAML has it, and what is needed to load its files.
struct BodyDraft {
  BodySpec spec;  // without mesh, texture and pinned vertices
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1.0;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  std::vector<PinDraft> pins;
  FormulaDraft stiffness_factor, mass_factor;  // of a soft body
  std::string pins_where, texture_where;
};

/// `folder` is what relative paths are relative to; `index` gives a nameless body its name.
BodyDraft read_body(const Node& node, int index, const std::filesystem::path& folder, const NodePtr& record);

/// Opens the mesh and the texture and finds the pins; `watch`, where there is one, hears of both before.
BodySpec load_body(BodyDraft draft, const FileWatch& watch);

/// `duration` [s] bounds the step.
SolverSpec read_solver(MapReader& scene, double duration);

/// water: into the scene.
void read_water(MapReader& map, Scene& scene);

/// Names in `bodies` are what a camera can follow; `followed` is the place of the one it does.
render::Settings read_render(MapReader& scene, double duration, const std::vector<std::string>& bodies,
                             std::optional<int>& followed);

std::optional<StripSpec> read_strip(MapReader& scene, double duration);

/// Of a cloth among the bodies.
std::optional<SpectrumSpec> read_spectrum(MapReader& scene, double duration, const std::vector<BodyDraft>& drafts);

}  // namespace billow::cli
