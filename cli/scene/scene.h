// A validated scene: what a scene file says once every key is checked, every mesh loaded and every pin found.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/scene/body_kind.h"
#include "cli/scene/cache_format.h"
#include "cli/yaml/yaml_overrides.h"
#include "render/image/finish.h"
#include "render/image/settings.h"
#include "render/image/spectrum.h"
#include "sim/body/keyed_motion.h"
#include "sim/contact/contact_options.h"
#include "sim/filter/filter.h"
#include "sim/force/water_force.h"
#include "sim/force/wind_force.h"
#include "sim/mesh/mesh.h"
#include "sim/step/schemes.h"

namespace billow::cli {

/// Where the time step comes from: a number, the certified limit times `safety`, or the paper's criterion times
/// `safety`.
enum class StepRule { fixed, automatic, paper };

struct SolverSpec {
  sim::Method method = sim::Method::fb_euler;
  sim::IntegratorOptions integrator;
  StepRule step_rule = StepRule::automatic;
  double step = 0.0;    // [s] for StepRule::fixed
  double safety = 0.9;  // in (0, 1], for the other two rules
  bool watch = true;    // smaller steps where the run goes wrong; otherwise it is only said
  std::optional<sim::FilterOptions> filter;
  bool levels_choose = false;     // their own ratio: filter->ratio says nothing
  std::string lambda_expression;  // lambda as a formula over the particles; empty: filter->lambda everywhere
  std::string filter_where;       // place in the scene of what the filter's faults are, lambda's or the ratio's
};

/// What the scene holds by one pin.
struct PinSpec {
  std::vector<int> vertices;    // ascending
  sim::KeyedMotion motion;      // that carries them along, from where the mesh has them
  std::optional<double> until;  // [s] > 0 when it lets go; none: never
};

/// What something is drawn with: what the scene says, or what its mesh's file does.
struct Look {
  std::filesystem::path texture_file;                 // empty: none of the scene's own
  std::string texture_where;                          // its place in the scene, for messages
  bool of_mesh = true;                                // without one: the mesh's materials and colours, where it has any
  std::optional<AlphaMode> alpha;                     // none: as the texture or the material has it
  Eigen::Vector3f colour{0.4564f, 0.4564f, 0.4564f};  // linear-light RGB
  std::vector<render::Finish> finish = {1, render::Finish()};  // once loaded: one for each of the mesh's materials
  bool shows_vertex_colours = false;                           // times the colours of its mesh's vertices
};

/// How a body touches others and itself.
struct ContactSpec {
  bool self = true;
  std::optional<double> thickness = {};  // [m]; none: by its mesh
  double friction = 0.3;                 // Coulomb's, of it against its like
};

/// One body of the scene, its mesh already imported.
struct BodySpec : Look {
  std::string name;
  std::filesystem::path mesh_file;  // empty: a fish without a drawn skin
  std::string mesh_where;           // place of the mesh in the scene, for messages
  sim::Mesh mesh;                   // where the body is, or what a fish is dressed in
  BodyKind kind;
  std::vector<PinSpec> pins;
  Eigen::Vector3d initial_velocity = Eigen::Vector3d::Zero();  // [m/s]
  std::optional<ContactSpec> contact;                          // none: it passes through everything
  std::vector<int> framed_points;     // of what is drawn, those that the fitted camera keeps in view; empty: all
  std::vector<std::string> warnings;  // of its mesh: sentences without an end mark
};

/// Something that bodies touch and cannot move.
struct ColliderSpec : Look {
  sim::Collider solid;
  std::filesystem::path mesh_file;  // empty: a shape that the scene describes
  std::string mesh_where;
};

struct StripSpec {
  double step = 0.01;  // [s] between columns
  StripOrder order = StripOrder::zigzag;
};

/// The spatial spectrum of one cloth's velocities, and the image that it is taken of.
struct SpectrumSpec {
  double step = 0.1;    // [s] between the samples that the mean is made of
  double at = 1.0;      // [s] of the velocity image that is shown
  double range = 80.0;  // [dB] from white, the strongest, to black
  render::Window window = render::Window::none;
  int body = 0;
};

struct Scene {
  std::filesystem::path file;
  double duration = 10.0;                    // [s] > 0
  Eigen::Vector3d gravity{0.0, -9.81, 0.0};  // [m/s^2]
  std::vector<BodySpec> bodies;
  std::vector<ColliderSpec> colliders;
  std::optional<sim::ContactOptions> contact;  // of bodies, colliders and, last, the ground; none: nothing touches
  sim::Water water;                            // around the fish
  int motes = 0;                               // drawn specks that drift in it
  std::optional<sim::Wind> wind;               // on cloths and soft bodies
  std::optional<int> followed;                 // the body that the camera stays beside
  SolverSpec solver;
  render::Settings render;
  std::vector<CacheFormat> caches;  // in the order in which they are written
  std::optional<StripSpec> strip;
  std::optional<SpectrumSpec> spectrum;
  std::string effective;      // the whole scene with every default written out, as YAML that reads back to this scene
  std::string hash;           // 16 hex digits over `effective` and the bytes of every file it names
  std::string timeless_hash;  // the same, however long it takes
  std::string motion_hash;    // over what of it moves, however long: scenes that agree in it have the same states
};

/// Told of a file that is about to be read.
using FileWatch = std::function<void(const std::filesystem::path&)>;

/// Reads and fully checks a scene file: syntax, duplicate and unknown keys, types, finiteness, ranges, meshes,
/// textures, pins. Relative paths are relative to the scene file. Throws InputError, its text starting with
/// "file:line:column: " (or "-D key.path: "), on the first fault.
/// `watch` hears of every mesh and texture before it is read.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                 const FileWatch& watch = {});

/// All bodies of the scene as one structure, in order. Throws InputError located at the mesh of a body that makes no
/// cloth or soft body.
sim::Structure build_structure(const Scene& scene);

}  // namespace billow::cli
