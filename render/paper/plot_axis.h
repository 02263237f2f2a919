// The ticks of an axis.
#pragma once

#include <string>
#include <vector>

namespace billow::render {

/// A mark along an axis; without a label a short one between others.
struct Tick {
  double at = 0.0;
  std::string label = {};
};

struct PlotAxis {
  double low = 0.0, high = 1.0;  // low < high; both above 0 where it is logarithmic
  std::vector<Tick> ticks = {};
};

/// A round step of which about `wanted` fit into `span`: 1, 2 or 5 times a power of ten.
double round_step(double span, double wanted);

/// From the tick below `least` to the one above `greatest`, with about `wanted` labels, of which there are at least
/// two.
PlotAxis linear_axis(double least, double greatest, double wanted);

/// The same for 0 < least <= greatest: a label at every power of ten, or every few of them where there are more than
/// `wanted`, and at 2 and 5 times those where there is room.
PlotAxis logarithmic_axis(double least, double greatest, double wanted);

/// The axis from and to `share` of its data's length beyond `least` and `greatest`, with those ticks that are within.
/// As it is where they are equal.
PlotAxis fitted(PlotAxis axis, double least, double greatest, bool logarithmic, double share);

/// The axis made longer where `least` or `greatest` is nearer to its end than `share` of its length.
PlotAxis with_room(PlotAxis axis, double least, double greatest, bool logarithmic, double share);

}  // namespace billow::render
