// What a mesh file claims to hold, against what it can hold.
#pragma once

#include <string>

#include "sim/import/mesh_import.h"

namespace billow::sim {

/// Throws InputError where a header's count of `what` is below 0, above `limit`, or more than a file of `bytes` bytes
/// can hold: a reader would make room for them, or work on them for minutes.
void check_claim(const std::string& what, long long count, long long limit, std::size_t bytes);

}  // namespace billow::sim
