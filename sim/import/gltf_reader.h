// glTF 2.0 files, text and binary.
#pragma once

#include "sim/import/mesh_import.h"

namespace billow::sim {

/// Reads a glTF 2.0 or GLB file (Khronos, ISO/IEC 12113): the meshes of its scene where its nodes, skins and morph
/// weights put them at rest; triangles, strips and fans; every accessor layout, normalised and sparse ones and those of
/// KHR_mesh_quantization included; base colour, its texture and alpha. Groups are the names of nodes, meshes and
/// materials; joints and attributes that begin with _ become weights. An extension that the file requires and billow
/// does not read is refused by its name. Throws InputError with the reason.
PolygonSoup read_gltf(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace billow::sim
