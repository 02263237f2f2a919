// Memory, or a thread, that is asked for and not there.
#pragma once

#include <stdexcept>

namespace billow {

/// Something that the tool cannot do without is not to be had, through no fault of its input (exit status 1).
struct ResourceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Says what is missing, "out of memory" say; must not allocate. Where it returns, whoever asked gets nothing, as ever.
using OutOfMemoryAction = void (*)(const char* missing);

/// From now on `action` is called wherever in the process, its libraries included, an allocation fails or a thread
/// cannot be started: most libraries, GL's drivers above all, crash or hang then, long before an exception reaches us.
/// Null: nothing is called, which is how a process begins. Sanitizers have allocators of their own, without it.
void set_out_of_memory_action(OutOfMemoryAction action);

}  // namespace billow
