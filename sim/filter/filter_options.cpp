// Words for a filter's options.
#include "sim/filter/filter_options.h"

namespace billow::sim {

Words<FilterKernel> words(FilterKernel) {
  static constexpr Word<FilterKernel> list[] = {{"exponential", FilterKernel::exponential},
                                                {"gaussian", FilterKernel::gaussian}};
  return list;
}

Words<FilterForm> words(FilterForm) {
  static constexpr Word<FilterForm> list[] = {
      {"plain", FilterForm::plain}, {"symmetric", FilterForm::symmetric}, {"conserving", FilterForm::conserving}};
  return list;
}

Words<FilterTarget> words(FilterTarget) {
  static constexpr Word<FilterTarget> list[] = {{"velocity", FilterTarget::velocity}, {"force", FilterTarget::force}};
  return list;
}

Words<FilterNeighbours> words(FilterNeighbours) {
  static constexpr Word<FilterNeighbours> list[] = {{"springs", FilterNeighbours::springs},
                                                    {"radius", FilterNeighbours::radius}};
  return list;
}

Words<FilterDistances> words(FilterDistances) {
  static constexpr Word<FilterDistances> list[] = {{"rest", FilterDistances::rest},
                                                   {"current", FilterDistances::current}};
  return list;
}

std::string_view name(FilterTarget target) { return word_of(target); }

}  // namespace billow::sim
