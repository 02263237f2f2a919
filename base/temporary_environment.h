// Environment variables that only the libraries called meanwhile see.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace billow {

/// Until it goes out of scope, getenv() finds the given values, or nothing for a name without one; then the environment
/// is what it was, and processes that are started later inherit nothing. Other threads may read the environment at the
/// same time, but not change it. What libraries got from getenv() stays valid for good: some bytes are kept per use.
class TemporaryEnvironment {
 public:
  using Change = std::pair<std::string, std::optional<std::string>>;

  explicit TemporaryEnvironment(const std::vector<Change>& changes);
  ~TemporaryEnvironment();
  TemporaryEnvironment(const TemporaryEnvironment&) = delete;
  TemporaryEnvironment& operator=(const TemporaryEnvironment&) = delete;

 private:
  char** before_;
};

}  // namespace billow
