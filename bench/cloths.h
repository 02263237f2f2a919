// The cloths that the benchmarks step.
#pragma once

#include <string>

#include "sim/body/structure.h"
#include "sim/mesh/mesh.h"

namespace billow::bench {

/// width x width particles, 1 m x 1 m, quads, numbered row by row.
sim::Mesh grid_mesh(int width);

/// The irregular cloth that ships, each triangle cut into four `halvings` times.
sim::Mesh irregular_mesh(int halvings);

/// A cloth of 0.2 kg with structural, shear and bend springs, two corners pinned.
sim::Structure cloth_of(const sim::Mesh& mesh);

/// A cloth by name: "grid 100" or "irregular 1". Built once, then kept.
const sim::Structure& cloth(const std::string& name);

}  // namespace billow::bench
