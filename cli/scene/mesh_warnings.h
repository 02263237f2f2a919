// What is odd about the mesh of a body.
#pragma once

#include <string>
#include <vector>

#include "cli/scene/scene.h"

namespace billow::cli {

/// Sentences without an end mark, for check and render: what of the file is not used, a size that looks like another
/// unit's unless `unit_given`, pieces of a pinned body that no pin holds, faces that are there twice or have no area.
std::vector<std::string> mesh_warnings(const BodySpec& body, bool unit_given);

/// One line for each body with a mesh: what it consists of.
std::vector<std::string> mesh_lines(const Scene& scene);

/// The vertices that a fitted camera keeps in view: those of the pieces that pins hold, where what no pin holds falls
/// through everything; empty: all.
std::vector<int> framed_vertices(const BodySpec& body);

/// Of all bodies, "body NAME: ...".
std::vector<std::string> mesh_warnings(const Scene& scene);

}  // namespace billow::cli
