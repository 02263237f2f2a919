// Leaving out springs that do nothing.
#pragma once

#include "sim/body/structure.h"

namespace billow::sim {

/// A structure of one body without its springs of stiffness 0.
Structure with_needed_springs(Structure structure);

}  // namespace billow::sim
