// Work done in a forked child under limits, so that its crash, hang or greed cannot take the tool down with it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace billow {

/// What the child may use before it is stopped.
struct ProcessLimits {
  std::size_t memory_bytes = 0;  // address space beyond the parent's; not enforced under sanitizers
  int cpu_seconds = 0;           // processor time, at least 1
  double wall_seconds = 0.0;     // clock time
  std::size_t reply_bytes = 0;   // longest reply
};

/// What `work` returns, computed in a forked child: nothing it does to memory comes back but its reply. The child is
/// silent and dies with the parent. Throws InputError with the text of whatever `work` threw, or with the reason why
/// the child gave no reply, and ResourceError where the system lets no child start or has less memory than the limits.
/// Call it before any other thread exists.
std::string reply_of_child(const std::function<std::string()>& work, const ProcessLimits& limits);

}  // namespace billow
