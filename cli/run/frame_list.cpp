// Lists of frames as users write them.
#include "cli/run/frame_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "base/error.h"

namespace billow::cli {

namespace {

std::optional<long> parse_whole(std::string_view text) {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1) return std::nullopt;
  return value;
}

std::optional<FrameSpan> parse_span(std::string_view text) {
  FrameSpan span;
  if (const std::size_t colon = text.find(':'); colon != text.npos) {
    const auto step = parse_whole(text.substr(colon + 1));
    if (!step || text.find('-') > colon) return std::nullopt;
    span.step = *step;
    text = text.substr(0, colon);
  }
  const std::size_t dash = text.find('-');
  const auto first = parse_whole(text.substr(0, dash));
  if (!first) return std::nullopt;
  span.first = *first;
  if (dash == text.npos) return span.last = span.first, span;
  if (dash + 1 == text.size()) return span;
  span.last = parse_whole(text.substr(dash + 1));
  return span.last && *span.last >= span.first ? std::optional(span) : std::nullopt;
}

std::string text_of(const FrameSpan& span) {
  return span.last == span.first ? std::to_string(span.first)
                                 : fmt::format("{}-{}", span.first, span.last ? std::to_string(*span.last) : "");
}

// From frames[begin] on at one distance: ends after the last of these. Two make no pattern, unless they are neighbours.
std::size_t end_of_progression(const std::vector<long>& frames, std::size_t begin) {
  std::size_t end = begin + 1;
  if (end == frames.size()) return end;
  const long step = frames[end] - frames[begin];
  while (end < frames.size() && frames[end] - frames[end - 1] == step) ++end;
  return step > 1 && end - begin < 3 ? begin + 1 : end;
}

std::string progression_text(long first, long last, long step) {
  if (first == last) return std::to_string(first);
  return fmt::format("{}–{}{}", first, last, step > 1 ? fmt::format(" by {}", step) : "");
}

}  // namespace

std::string frames_text(const std::vector<long>& frames) {
  constexpr std::size_t most_pieces = 8;
  std::vector<std::string> pieces;
  for (std::size_t begin = 0, end; begin < frames.size(); begin = end) {
    end = end_of_progression(frames, begin);
    const long step = end - begin > 1 ? frames[begin + 1] - frames[begin] : 1;
    pieces.push_back(progression_text(frames[begin], frames[end - 1], step));
  }
  if (pieces.size() > most_pieces) {
    pieces.erase(pieces.begin() + most_pieces / 2, pieces.end() - 1);
    pieces.insert(pieces.end() - 1, "…");
  }
  return fmt::format("{}", fmt::join(pieces, ", "));
}

std::string frames_text(const FrameRange& range) {
  return range.listed.empty() ? progression_text(range.first, range.last, 1) : frames_text(range.listed);
}

bool FrameRange::contains(long frame) const {
  if (frame < first || frame > last) return false;
  return listed.empty() || std::binary_search(listed.begin(), listed.end(), frame);
}

long FrameRange::count() const { return listed.empty() ? last - first + 1 : static_cast<long>(listed.size()); }

std::optional<std::vector<FrameSpan>> parse_frames(const std::string& text) {
  std::vector<FrameSpan> spans;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const auto span = parse_span(std::string_view(text).substr(at, end - at));
    if (!span) return std::nullopt;
    spans.push_back(*span);
    at = end + 1;
  }
  return spans;
}

std::string list_text(const std::vector<long>& numbers) {
  std::string text;
  for (std::size_t begin = 0, end = 0; begin < numbers.size(); begin = end) {
    while (end < numbers.size() && numbers[end] - numbers[begin] == static_cast<long>(end - begin)) ++end;
    text += (text.empty() ? "" : ",") + text_of(FrameSpan{numbers[begin], numbers[end - 1]});
  }
  return text;
}

std::vector<long> numbers_in(const std::vector<FrameSpan>& spans, long total, std::string_view option,
                             std::string_view whole) {
  std::vector<long> numbers;
  for (const FrameSpan& span : spans) {
    if (span.first > total || span.last.value_or(total) > total)
      throw InputError(fmt::format("{} {}: {} 1 to {}", option, text_of(span), whole, total));
    const long last = span.last.value_or(total);
    for (long k = 0; k <= (last - span.first) / span.step; ++k) numbers.push_back(span.first + k * span.step);
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

FrameRange frames_in(const std::vector<FrameSpan>& spans, long total) {
  std::vector<long> frames = numbers_in(spans, total, "--frames", "the scene has frames");
  FrameRange range{frames.front(), frames.back(), {}};
  if (static_cast<long>(frames.size()) < range.count()) range.listed = std::move(frames);
  return range;
}

}  // namespace billow::cli
