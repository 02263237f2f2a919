// The colours of a mesh's vertices on its drawn surface.
#pragma once

#include "cli/scene/scene.h"
#include "sim/drawn/surface.h"

namespace billow::cli {

/// `surface`, whose points are the vertices of `mesh`, in their colours where the look shows these.
sim::Surface painted(sim::Surface surface, const sim::Mesh& mesh, const Look& look);

}  // namespace billow::cli
