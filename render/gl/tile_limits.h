// How much of a picture is drawn at a time.
#pragma once

namespace billow::render {

/// The most pixels [drawn] that are held at a time, so that a picture's size is not bound by GL's memory: with 4
/// samples a pixel takes 40 bytes. Larger pictures are drawn tile by tile; where their tiles lie decides about last
/// bits, so that these limits do not follow the machine.
struct TileLimits {
  int side = 4096;            // even
  int pixels = 1 << 23;       // of a tile
  int data_viewport = 16384;  // [sample] each way of the views of numbers, which have tiles of their own; even
};

}  // namespace billow::render
