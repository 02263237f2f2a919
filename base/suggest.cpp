// "Did you mean …?" for misspelt keys and names.
#include "base/suggest.h"

#include <fmt/format.h>

#include <algorithm>

namespace billow {
namespace {

// Words further apart than a third of their length have nothing to do with each other, nor have 3 and 8.
bool near(std::string_view word, std::string_view candidate, int distance) {
  const int length = static_cast<int>(std::max(word.size(), candidate.size()));
  return distance <= (length < 3 ? 0 : std::max(1, length / 3));
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool same(char a, char b) { return lower(a) == lower(b); }

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> two_back(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substitution = previous[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]);
      if (swapped) current[j] = std::min(current[j], two_back[j - 2] + 1);
    }
    two_back.swap(previous);
    previous.swap(current);
  }
  return previous[b.size()];
}

std::string_view closest_name(std::string_view word, const std::vector<std::string_view>& candidates) {
  // A key of a kilobyte is no typing mistake, and its distance would take a while.
  constexpr std::size_t longest = 64;
  if (word.size() > longest) return {};
  std::string_view best;
  int best_distance = longest + 1;
  for (const std::string_view candidate : candidates) {
    const int distance = edit_distance(word, candidate);
    if (distance < best_distance && near(word, candidate, distance)) best = candidate, best_distance = distance;
  }
  return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates, std::string_view label) {
  if (const std::string_view best = closest_name(word, candidates); !best.empty())
    return fmt::format("; did you mean '{}'?", best);
  return fmt::format("; {}: {}", label, fmt::join(candidates, ", "));
}

}  // namespace billow
