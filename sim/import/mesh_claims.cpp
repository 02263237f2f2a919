// Counts in headers.
#include "sim/import/mesh_claims.h"

#include <fmt/format.h>

#include "base/error.h"

namespace billow::sim {

void check_claim(const std::string& what, long long count, long long limit, std::size_t bytes) {
  if (count < 0) throw InputError(fmt::format("its header claims {} {}; it is broken, export it again", count, what));
  if (static_cast<unsigned long long>(count) > bytes)
    throw InputError(fmt::format(
        "its header claims {} {}, but the file has only {} bytes; it is truncated or broken, export it again", count,
        what, bytes));
  if (count > limit)
    throw InputError(fmt::format("it has {} {}, and the limit is {}; use a coarser mesh", count, what, limit));
}

}  // namespace billow::sim
