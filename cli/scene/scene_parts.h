// The parts of a scene file, each read by a file of its own. Reading needs no other file; loading does, so that every
// fault of the YAML is found before the first mesh is opened.
#pragma once

#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/scene/placement_reader.h"
#include "cli/scene/scene.h"
#include "cli/yaml/yaml_reader.h"
#include "sim/mesh/selection.h"

namespace billow::cli {

/// [rad]
inline double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

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
  std::vector<sim::PlaceKey> motion;
  std::optional<Eigen::Vector3d> pivot;  // [m] none: the mean of its vertices
  std::optional<double> until;           // [s]
  std::string where;
};

/// A formula over a body's particles (particle_expression.h), and where it stands.
struct FormulaDraft {
  std::string text = "1", where;
};

/// A body as the YAML has it, and what is needed to load its files.
struct BodyDraft {
  BodySpec spec;  // without mesh, texture and pins
  Placement placement;
  std::vector<PinDraft> pins;
  FormulaDraft stiffness_factor, mass_factor;  // of a soft body
  std::string pins_where;
  bool unit_given = false;  // the scene says what the mesh's lengths are, or scales them
  std::string shear_where;  // of a cloth's material, where it says one
  NodePtr open_contact;     // entered for `contact` where the body does not say it; null where it does
};

/// `folder` is what relative paths are relative to; `index` gives a nameless body its name.
BodyDraft read_body(const Node& node, int index, const std::filesystem::path& folder, const NodePtr& record);

class TextureBudget;

/// Opens the mesh and the texture and finds the pins; `watch`, where there is one, hears of both before.
BodySpec load_body(BodyDraft draft, const FileWatch& watch, TextureBudget& budget);

/// Throws InputError unless a body or a collider can be called that.
void check_name(const std::string& name, const std::string& where);

/// texture: and colour:.
void read_look(MapReader& map, const std::filesystem::path& folder, Look& look);

/// contact: of a body whose kind is known. Where it says nothing, settle_contact decides.
void read_contact(MapReader& body, BodyDraft& draft);

/// Lets the bodies that say nothing of contact touch with their defaults, where a body says so or there is something to
/// touch besides bodies; what they are then is entered in their records.
void settle_contact(std::vector<BodyDraft>& drafts, bool something_to_touch);

/// What of the scene touches what, the ground last; none where no body touches anything.
std::optional<sim::ContactOptions> contact_of(const Scene& scene, const std::optional<sim::Collider>& ground);

/// A collider as the YAML has it, and what is needed to load its files.
struct ColliderDraft {
  ColliderSpec spec;    // without texture, motion and what is in its mesh file
  Placement placement;  // of the mesh in the file
  std::vector<sim::PlaceKey> motion;
  std::optional<Eigen::Vector3d> pivot;  // [m] none: the middle of its mesh's box
};

/// As read_body.
ColliderDraft read_collider(const Node& node, int index, const std::filesystem::path& folder, const NodePtr& record);

/// As load_body.
ColliderSpec load_collider(ColliderDraft draft, const FileWatch& watch, TextureBudget& budget);

/// `duration` [s] bounds the step.
SolverSpec read_solver(MapReader& scene, double duration);

/// water: into the scene.
void read_water(MapReader& map, Scene& scene);

std::optional<sim::Wind> read_wind(MapReader& scene);

/// render: and what of it is no setting of the pictures.
struct RenderDraft {
  render::Settings settings;
  std::optional<int> followed;          // place of the body that the camera stays beside
  std::optional<sim::Collider> ground;  // where it collides
  std::string ground_where;
};

/// Names in `bodies` are what a camera can follow.
RenderDraft read_render(MapReader& scene, double duration, const std::vector<std::string>& bodies);

/// Which caches of its geometry a run writes.
std::vector<CacheFormat> read_caches(MapReader& scene);

std::optional<StripSpec> read_strip(MapReader& scene, double duration);

/// Of a cloth among the bodies.
std::optional<SpectrumSpec> read_spectrum(MapReader& scene, double duration, const std::vector<BodyDraft>& drafts);

}  // namespace billow::cli
