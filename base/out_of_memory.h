// Memory, or a thread, that is asked for and not there.
#pragma once

#include <cstddef>
#include <stdexcept>

namespace billow {

/// Something that the tool cannot do without is not to be had, through no fault of its input (exit status 1).
struct ResourceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Is told what is missing, "out of memory" say, and how many bytes were asked for (0: not known); must not allocate.
using OutOfMemoryAction = void (*)(const char* missing, std::size_t bytes);

/// What is done wherever in the process, its libraries included, an allocation fails or a thread cannot be started:
/// most libraries, GL's drivers above all, crash or hang then, long before an exception reaches us. From the first
/// instruction the process tidies up (sudden_end.h), says on stderr what is missing and ends with status 1; from here
/// on it calls `action`. Where that returns, whoever asked gets nothing, as ever. Under sanitizers, which have
/// allocators of their own, nothing is done.
void set_out_of_memory_action(OutOfMemoryAction action);

}  // namespace billow
