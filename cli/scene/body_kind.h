// The kinds of bodies that a scene can have. What depends on the kind is asked here and nowhere else: every kind
// answers the same questions, and one that misses an answer does not compile.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "base/words.h"
#include "cli/scene/fabric.h"
#include "sim/body/cloth.h"
#include "sim/body/fish.h"
#include "sim/body/fish_motion.h"
#include "sim/body/soft_body.h"
#include "sim/drawn/skin.h"
#include "sim/force/forces.h"

namespace billow::cli {

struct BodyDraft;
struct BodySpec;
struct ContactSpec;
struct Scene;
class MapReader;

/// Which particle each row of the strip shows: the zig-zag of the paper's Figure 3, or the mesh file's own order.
enum class StripOrder { zigzag, mesh };
Words<StripOrder> words(StripOrder);

/// What the rows of a body's part of the strip show.
struct BodyRows {
  std::vector<int> particles;  // of the body, in order
  Eigen::MatrixXd weight;      // (rows x particles), or empty: a row for each particle
};

/// A body whose particles are the vertices of its mesh.
struct MeshBody {
  std::optional<double> density;         // [kg/m^2] of a cloth, [kg/m^3] of a soft body; none: its mass is given
  std::optional<double> max_eigenvalue;  // [1/s^2] scales all stiffnesses so that lambda_max(M^-1 K) at rest is this

  /// What blows on it.
  void add_laws(const Scene& scene, const sim::Structure& structure, int body, sim::Forces& forces) const;
  sim::Skin skin(const BodySpec& body) const;
  BodyRows rows(const BodySpec& body, StripOrder order) const;
  const sim::Mesh& particle_mesh(const BodySpec& body) const;
  sim::Mesh touching_mesh(const BodySpec& body) const;
};

struct ClothSpec : MeshBody {
  sim::ClothOptions options;
  std::optional<Fabric> fabric;        // what the scene leaves to it goes by the mesh:
  bool mass_of_fabric = false;         //   its area,
  bool bend_of_fabric = false;         //   and the length of its edges,
  bool buckling_of_fabric = false;     //   as well
  std::optional<double> strain_limit;  // [rest lengths] of structural and shear springs

  bool takes_spectrum() const { return true; }
  std::optional<double> most_strain() const { return strain_limit; }
  ContactSpec contact_by_kind() const;
  void place(const sim::Mesh& mesh, const BodyDraft& draft, BodySpec& body);
  sim::Structure build(const BodySpec& body) const;
};

struct SoftSpec : MeshBody {
  sim::SoftBodyOptions options;
  bool close_holes = false;  // of its mesh

  bool takes_spectrum() const { return false; }
  std::optional<double> most_strain() const { return std::nullopt; }
  ContactSpec contact_by_kind() const;
  void place(const sim::Mesh& mesh, const BodyDraft& draft, BodySpec& body);
  sim::Structure build(const BodySpec& body) const;
};

struct FishSpec {
  sim::FishOptions options;
  sim::MotionOptions motion;
  double buoyancy = 1.0;  // share of the weight that the water carries

  bool takes_spectrum() const { return false; }
  std::optional<double> most_strain() const { return std::nullopt; }
  ContactSpec contact_by_kind() const;
  void place(const sim::Mesh& mesh, const BodyDraft& draft, BodySpec& body);
  sim::Structure build(const BodySpec& body) const;
  void add_laws(const Scene& scene, const sim::Structure& structure, int body, sim::Forces& forces) const;
  sim::Skin skin(const BodySpec& body) const;
  BodyRows rows(const BodySpec& body, StripOrder order) const;
  const sim::Mesh& particle_mesh(const BodySpec& body) const;
  sim::Mesh touching_mesh(const BodySpec& body) const;
};

using BodyKind = std::variant<ClothSpec, SoftSpec, FishSpec>;

/// How a scene names a kind, and what reads it from there into a draft. Files are looked for below `folder`.
struct BodyKindRow {
  std::string_view key;
  void (*read)(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft);
};

void read_cloth(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft);
void read_soft(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft);
void read_fish(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft);

/// In the order in which messages list them.
inline constexpr BodyKindRow body_kinds[] = {{"cloth", read_cloth}, {"soft", read_soft}, {"fish", read_fish}};

/// Gives the body its imported mesh: moved, its pins and variations found; throws InputError located in the scene.
void place_mesh(const sim::Mesh& mesh, const BodyDraft& draft, BodySpec& body);
/// Its particles and springs. Throws InputError.
sim::Structure build_body(const BodySpec& body);
/// Adds what pushes it besides springs, friction and gravity; it is `structure.body[number]`.
void add_laws(const Scene& scene, const sim::Structure& structure, int number, sim::Forces& forces);
/// What is drawn of it.
sim::Skin skin_of(const BodySpec& body);
BodyRows rows_of(const BodySpec& body, StripOrder order);
/// Whether its velocities make an image over its texture.
bool takes_spectrum(const BodySpec& body);
/// The mesh whose vertices are its particles; an empty one for bodies that are only dressed in theirs.
const sim::Mesh& particle_mesh(const BodySpec& body);
/// [rest lengths] by which its structural and shear springs may be stretched, where that is limited.
std::optional<double> most_strain(const BodySpec& body);
/// How it touches where the scene does not say.
ContactSpec contact_by_kind(const BodySpec& body);
/// Its particles at rest and the faces between them that touch others.
sim::Mesh touching_mesh(const BodySpec& body);

}  // namespace billow::cli
