// Mesh files -> Mesh, in a child process that cannot take the tool down with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// What the importing child process may use before it is stopped.
struct ImportLimits {
  std::size_t memory_bytes = std::size_t{1} << 30;  // address space beyond the parent's
  int cpu_seconds = 10;                             // processor time; small files get less
  double wall_seconds = 20.0;                       // clock time
  std::uintmax_t max_file_bytes = 1u << 28;         // of the file and of each file it refers to
  int max_vertices = 2'000'000;                     // raw: an OBJ or STL file has one for every corner of a face
  int max_faces = 4'000'000;
};

/// Reads an OBJ, OFF, STL, PLY, glTF or GLB file (by its extension) in double precision and welds it. Vertices are
/// numbered as the file numbers them (STL, which has no numbers: in order of appearance). Quads stay quads; larger
/// polygons become fans of triangles, concave ones triangles inside them. Groups are an OBJ's `g`, `o` and `usemtl`
/// names, and the node, mesh and material names of other files. Reads in a forked child under `limits`; a crash, a hang
/// or an over-large file becomes an InputError that names the file and the reason; of a file that may not be quoted
/// (base/file_trust.h) and is no mesh, without its words. Call it before any other thread exists.
Mesh import_mesh(const std::filesystem::path& file, const ImportLimits& limits = {});

}  // namespace billow::sim
