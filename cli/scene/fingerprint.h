// What tells one scene from another.
#pragma once

#include "cli/scene/scene.h"
#include "cli/yaml/yaml_tree.h"

namespace billow::cli {

/// The hashes of a loaded scene whose record is `effective`, into it.
void take_fingerprints(const NodePtr& effective, Scene& scene);

}  // namespace billow::cli
