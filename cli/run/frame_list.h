// Which frames of a scene are meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billow::cli {

/// Frames, 1-based. Frame f shows the time (f - 1) / fps.
struct FrameRange {
  long first = 1, last = 0;
  std::vector<long> listed = {};  // ascending, from first to last, where some in between are not meant; else empty

  bool contains(long frame) const;
  long count() const;
};

/// One piece of a list of frames: "7", "1-250", "300-" (to the scene's last) or "1-250:5" (every fifth).
struct FrameSpan {
  long first = 1;
  std::optional<long> last = {};
  long step = 1;
};

/// "1-3,7": ascending numbers, as such a list.
std::string list_text(const std::vector<long>& numbers);

/// Reads pieces with commas between them. Nothing where `text` is no such list.
std::optional<std::vector<FrameSpan>> parse_frames(const std::string& text);

/// "61–70, 100–250 by 50": ascending frames as a sentence names them. Of a long list only both ends are named.
std::string frames_text(const std::vector<long>& frames);
std::string frames_text(const FrameRange& range);

/// Those of the numbers 1 to `total` that the spans mean, ascending, each once. Throws InputError when a span ends
/// beyond them, "OPTION SPAN: WHOLE 1 to TOTAL".
std::vector<long> numbers_in(const std::vector<FrameSpan>& spans, long total, std::string_view option,
                             std::string_view whole);

/// Those of the frames 1 to `total` that the spans mean. Throws InputError when a span ends beyond them.
FrameRange frames_in(const std::vector<FrameSpan>& spans, long total);

}  // namespace billow::cli
