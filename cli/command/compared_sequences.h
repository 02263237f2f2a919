// Frames of one film among the pairs of a comparison: where it begins to differ, and how much by frame.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/command/compared_images.h"

namespace billow::cli {

/// At least three pairs whose names differ in their last number alone.
struct ComparedSequence {
  struct Frame {
    long number = 0;
    std::size_t pair = 0;  // its place among the pairs
  };
  std::string name;                                            // "textured/frame_####.png"
  std::vector<Frame> frames;                                   // ascending
  std::optional<Frame> first_unequal, first_different, worst;  // by any value; by its verdict; most pixels over
  std::size_t different = 0;                                   // frames that are not the same
};

std::vector<ComparedSequence> sequences_of(const std::vector<ComparedPair>& pairs);

/// In a line: "textured/frame_####.png: 250 frames, 209 differ, the first 42, unequal from 18 on; the worst 120: …".
std::string sequence_text(const ComparedSequence& sequence, const std::vector<ComparedPair>& pairs);

}  // namespace billow::cli
