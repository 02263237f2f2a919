// What cloths and soft bodies have in common: a scene says alike where their mesh is and what their surface is made of.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/scene/scene_parts.h"
#include "cli/yaml/yaml_reader.h"

namespace billow::cli {

/// The map of a kind in a body, and where its keys are listed (scene_keys.h).
struct KindMap {
  MapReader map;
  std::string path;  // "bodies[].cloth"

  const Section& section(std::string_view key) const;
  MapReader submap(std::string_view key) { return map.map(key, section(key)); }
};

/// `body`'s map of the kind `key`.
KindMap kind_map(MapReader& body, std::string_view key);

/// mesh: and transform:.
void read_mesh(KindMap& kind, const std::filesystem::path& folder, BodyDraft& draft);
/// density: with the refusal of a mass beside it; returns whether it is given.
bool read_density(KindMap& kind, MeshBody& body);
/// Refuses `key` beside material:.
void refuse_beside_material(KindMap& kind, std::string_view key);
/// mass: and mass_distribution:.
void read_mass(KindMap& kind, sim::ClothOptions& options);
/// mass_distribution: alone.
void read_mass_distribution(KindMap& kind, sim::ClothOptions& options);
/// structural:, shear: and bend: of a map of stiffnesses.
void read_surface_springs(MapReader& stiffness, sim::ClothOptions& options);
/// damping:.
void read_damping(KindMap& kind, sim::ClothOptions& options);
/// velocity: and pins:.
void read_start(KindMap& kind, BodyDraft& draft);

/// The mesh where the draft puts it.
sim::Mesh placed(const sim::Mesh& mesh, const BodyDraft& draft);
/// The draft's pins on the mesh where it is placed. Throws InputError located at a pin.
std::vector<PinSpec> placed_pins(const sim::Mesh& mesh, const BodyDraft& draft);
/// The structure with all its stiffnesses scaled, where the body has a highest eigenvalue.
sim::Structure scaled(sim::Structure structure, const MeshBody& body);

}  // namespace billow::cli
