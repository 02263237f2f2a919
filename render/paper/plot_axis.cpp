// Round numbers around data.
#include "render/paper/plot_axis.h"

#include <algorithm>
#include <cmath>

#include "base/readable_number.h"

namespace billow::render {

namespace {

constexpr double rounding = 1e-9;  // of a step: what counts as standing on a tick

int decimals_of_step(double step) { return std::max(0, static_cast<int>(-std::floor(std::log10(step) + rounding))); }

// All ticks of an axis with the same decimals, or all with a power of ten.
std::string tick_label(double at, double step, double largest) {
  if (step >= 1e-4 && largest < 1e7) return readable_fixed(at, decimals_of_step(step));
  return readable(std::abs(at) < 0.5 * step ? 0.0 : at, 6);
}

void add_linear_ticks(PlotAxis& axis, double step) {
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  for (double k = std::ceil(axis.low / step - rounding); k * step <= axis.high + rounding * step; ++k)
    axis.ticks.push_back({k * step, tick_label(k * step, step, largest)});
}

// The label of 10^exponent: plain where the whole axis is easily read so.
std::string decade_label(int exponent, bool plain) {
  return plain ? readable(std::pow(10.0, exponent)) : power_of_ten(exponent);
}

constexpr int finest_decade = -3, largest_plain_decade = 5;

/// Powers of ten from `first` to `last`, which an axis touches.
struct Decades {
  int first, last;
  bool plain() const { return first >= finest_decade && last <= largest_plain_decade; }
};

// Labels at every `every`th power of ten; marks between: the powers left out, or the whole multiples of each.
void add_decades(PlotAxis& axis, const Decades& decades, int every) {
  for (int exponent = decades.first; exponent <= decades.last; ++exponent) {
    const bool labelled = ((exponent % every) + every) % every == 0;
    axis.ticks.push_back({std::pow(10.0, exponent), labelled ? decade_label(exponent, decades.plain()) : ""});
    for (int digit = 2; every == 1 && digit <= 9 && exponent < decades.last; ++digit)
      axis.ticks.push_back({digit * std::pow(10.0, exponent)});
  }
}

// 1, 2 and 5 times every power of ten, from the one at or below `least` to the one at or above `greatest`.
void add_digits(PlotAxis& axis, double least, double greatest, const Decades& decades) {
  std::vector<double> at;
  for (int exponent = decades.first; exponent <= decades.last; ++exponent)
    for (const double digit : {1.0, 2.0, 5.0}) at.push_back(digit * std::pow(10.0, exponent));
  const auto low = std::prev(std::upper_bound(at.begin(), at.end(), least * (1.0 + rounding)));
  const auto high = std::lower_bound(at.begin(), at.end(), greatest * (1.0 - rounding));
  axis.low = *low, axis.high = high == low ? *std::next(low) : *high;
  for (const double tick : at)
    if (tick >= axis.low && tick <= axis.high) axis.ticks.push_back({tick, readable(tick)});
}

// `at` moved by `share` of the way from `least` to `greatest`.
double beyond(double at, double least, double greatest, bool logarithmic, double share) {
  return logarithmic ? at * std::pow(greatest / least, share) : at + share * (greatest - least);
}

}  // namespace

double round_step(double span, double wanted) {
  const double raw = span / wanted, power = std::pow(10.0, std::floor(std::log10(raw)));
  const double digit = raw / power;
  return power * (digit <= 1.0 ? 1.0 : digit <= 2.0 ? 2.0 : digit <= 5.0 ? 5.0 : 10.0);
}

PlotAxis linear_axis(double least, double greatest, double wanted) {
  // A constant gets an axis a fifth as wide as itself.
  const double size = std::max(std::abs(least), std::abs(greatest));
  const double margin = greatest - least > 1e-9 * size ? 0.0 : size > 0.0 ? 0.1 * size : 1.0;
  const double step = round_step(greatest - least + 2.0 * margin, std::max(1.0, wanted));
  PlotAxis axis{step * std::floor((least - margin) / step + rounding),
                step * std::ceil((greatest + margin) / step - rounding)};
  add_linear_ticks(axis, step);
  return axis;
}

PlotAxis logarithmic_axis(double least, double greatest, double wanted) {
  const double span = std::log10(greatest / least);
  const Decades decades{static_cast<int>(std::floor(std::log10(least) + rounding)),
                        static_cast<int>(std::ceil(std::log10(greatest) - rounding))};
  // Less than a factor of two or so has no round powers within: ticks as on a linear axis, at their logarithms.
  if (span > 0.0 && span < 0.35) {
    PlotAxis axis = linear_axis(least, greatest, wanted);
    if (axis.low > 0.0) return axis;
  }
  PlotAxis axis;
  if (span > 0.0 && 3.0 * span <= wanted && decades.first >= finest_decade - 1) {
    add_digits(axis, least, greatest, {decades.first, decades.last + 1});
    return axis;
  }
  const double middle = std::log10(least);
  const Decades around{static_cast<int>(std::floor(middle - 0.5)), static_cast<int>(std::ceil(middle + 0.5))};
  const Decades shown = span > 0.0 ? Decades{decades.first, std::max(decades.last, decades.first + 1)} : around;
  axis.low = std::pow(10.0, shown.first), axis.high = std::pow(10.0, shown.last);
  add_decades(axis, shown, std::max(1, static_cast<int>(std::ceil((shown.last - shown.first) / wanted))));
  return axis;
}

PlotAxis fitted(PlotAxis axis, double least, double greatest, bool logarithmic, double share) {
  if (!(least < greatest)) return axis;
  axis.low = beyond(least, least, greatest, logarithmic, -share);
  axis.high = beyond(greatest, least, greatest, logarithmic, share);
  std::erase_if(axis.ticks, [&](const Tick& tick) { return tick.at < axis.low || tick.at > axis.high; });
  return axis;
}

PlotAxis with_room(PlotAxis axis, double least, double greatest, bool logarithmic, double share) {
  const double low = axis.low, high = axis.high;
  axis.low = std::min(low, beyond(least, low, high, logarithmic, -share));
  axis.high = std::max(high, beyond(greatest, low, high, logarithmic, share));
  return axis;
}

}  // namespace billow::render
