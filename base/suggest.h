// "Did you mean …?" for misspelt keys and names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace billow {

/// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours, each costing 1;
/// upper and lower case are the same.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate that `word` is most likely a slip of: the nearest, and at most a third of its letters away; or "".
std::string_view closest_name(std::string_view word, const std::vector<std::string_view>& candidates);

/// The end of a message about the unknown `word`: "; did you mean 'stiffness'?", or, when no candidate is near,
/// "; LABEL: first, second, …".
std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates, std::string_view label);

}  // namespace billow
