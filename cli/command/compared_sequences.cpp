// Names with their last number left out -> frames.
#include "cli/command/compared_sequences.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <tuple>

namespace billow::cli {

namespace {

constexpr std::size_t least_frames = 3;  // of fewer a curve says nothing that the rows do not

/// The last number in the stem of a name, and the name with # for its digits.
struct NumberedName {
  std::string pattern;
  long number = -1;  // none
};

NumberedName numbered(const std::string& name) {
  const std::size_t stem_end = std::min(name.rfind('.'), name.size());
  const std::size_t slash = name.rfind('/');
  const std::size_t last = name.find_last_of("0123456789", stem_end == 0 ? 0 : stem_end - 1);
  if (last == std::string::npos || (slash != std::string::npos && last < slash)) return {};
  std::size_t begin = last + 1;
  while (begin > 0 && name[begin - 1] >= '0' && name[begin - 1] <= '9') --begin;
  NumberedName result{name.substr(0, begin) + std::string(last + 1 - begin, '#') + name.substr(last + 1)};
  const auto [end, error] = std::from_chars(name.data() + begin, name.data() + last + 1, result.number);
  return error == std::errc() ? result : NumberedName{};
}

// A test without pictures is a row, but no frame.
bool names_picture(const std::string& name) { return std::filesystem::path(name).has_extension(); }

bool is_unequal(const ComparedPair& pair) { return !pair.comparison || pair.comparison->apart > 0.0; }

auto badness(const ComparedPair& pair) {
  return pair.comparison ? std::make_tuple(pair.comparison->share_over, pair.comparison->apart)
                         : std::make_tuple(-1.0, 0.0);
}

void summarize(ComparedSequence& sequence, const std::vector<ComparedPair>& pairs) {
  for (const ComparedSequence::Frame& frame : sequence.frames) {
    const ComparedPair& pair = pairs[frame.pair];
    if (!sequence.first_unequal && is_unequal(pair)) sequence.first_unequal = frame;
    if (pair.verdict != Verdict::same && !sequence.first_different) sequence.first_different = frame;
    sequence.different += pair.verdict != Verdict::same;
    if (pair.comparison && is_unequal(pair) &&
        (!sequence.worst || badness(pair) > badness(pairs[sequence.worst->pair])))
      sequence.worst = frame;
  }
}

}  // namespace

std::vector<ComparedSequence> sequences_of(const std::vector<ComparedPair>& pairs) {
  std::map<std::string, std::vector<ComparedSequence::Frame>> groups;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (const NumberedName name = numbered(pairs[k].name); name.number >= 0 && names_picture(pairs[k].name))
      groups[name.pattern].push_back({name.number, k});
  std::vector<ComparedSequence> sequences;
  for (auto& [name, frames] : groups) {
    if (frames.size() < least_frames) continue;
    std::sort(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    sequences.push_back({name, frames, {}, {}, {}, 0});
    summarize(sequences.back(), pairs);
  }
  return sequences;
}

std::string sequence_text(const ComparedSequence& s, const std::vector<ComparedPair>& pairs) {
  std::string text = fmt::format("{}: {} frames, ", s.name, s.frames.size());
  if (!s.first_unequal) return text + "all equal";
  text += s.first_different ? fmt::format("{} differ{}, the first {}", s.different, s.different == 1 ? "s" : "",
                                          s.first_different->number)
                            : std::string("all the same");
  if (!s.first_different || s.first_unequal->number < s.first_different->number)
    text += fmt::format(", unequal from {} on", s.first_unequal->number);
  if (s.worst) text += fmt::format("; the worst {}: {}", s.worst->number, pairs[s.worst->pair].why);
  return text;
}

}  // namespace billow::cli
