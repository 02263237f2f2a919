// Which bodies are numbered so regularly that their neighbours lie at a few constant distances.
#pragma once

#include <utility>
#include <vector>

namespace billow::sim {

/// The distinct distances j - i > 0 of `pairs` (i < j), when storing a place for each at each of `particles` wastes
/// little: few distances, most of their places taken, no pair twice. Ascending, as the pairs are; empty otherwise.
std::vector<int> common_strides(const std::vector<std::pair<int, int>>& pairs, int particles);

}  // namespace billow::sim
