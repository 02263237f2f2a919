// "Did you mean ...?" for names that do not exist.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace billow::sim {

/// The candidate that `word` is most likely a slip of (fewest letters changed, at most a third of them), or "".
std::string closest_name(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace billow::sim
