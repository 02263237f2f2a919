// What can go wrong that is not a fault of billow itself. The command line turns each type into its exit status.
#pragma once

#include <stdexcept>
#include <string>

namespace billow {

/// A scene, mesh or texture that cannot be used (exit status 4). The text says what is wrong and what to do.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The simulation left every sensible bound (exit status 5).
struct DivergenceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The same, where no step is to blame: the text says what is in the way of what.
struct BlockedError : DivergenceError {
  using DivergenceError::DivergenceError;
};

/// A result could not be written (exit status 6).
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace billow
