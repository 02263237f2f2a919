// Words for a filter's options.
#include "sim/filter/filter_options.h"

namespace billow::sim {

Words<FilterKernel> words(FilterKernel) {
  static constexpr Word<FilterKernel> list[] = {{"exponential", FilterKernel::exponential},
                                                {"gaussian", FilterKernel::gaussian},
                                                {"levels", FilterKernel::levels}};
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

double lambda_factor(const FilterOptions& options, double time) {
  const auto& keys = options.lambda_keys;
  if (keys.empty()) return 1.0;
  if (time <= keys.front().first) return keys.front().second;
  for (std::size_t k = 1; k < keys.size(); ++k)
    if (time < keys[k].first) {
      const double t = (time - keys[k - 1].first) / (keys[k].first - keys[k - 1].first);
      return keys[k - 1].second + t * (keys[k].second - keys[k - 1].second);
    }
  return keys.back().second;
}

FilterOptions frozen_options(FilterOptions options, double time) {
  const double factor = lambda_factor(options, time);
  options.lambda *= factor;
  options.particle_lambda *= factor;
  options.lambda_keys.clear();
  options.distances = FilterDistances::rest;
  return options;
}

// Between keys the factor is never beyond them.
std::vector<double> times_of_extremes(const FilterOptions& options, double duration) {
  double weakest = 0.0, strongest = 0.0;
  const auto consider = [&](double time) {
    if (lambda_factor(options, time) > lambda_factor(options, weakest)) weakest = time;
    if (lambda_factor(options, time) < lambda_factor(options, strongest)) strongest = time;
  };
  consider(duration);
  for (const auto& [time, factor] : options.lambda_keys)
    if (time >= 0.0 && time <= duration) consider(time);
  if (lambda_factor(options, weakest) == lambda_factor(options, strongest)) return {weakest};
  return {weakest, strongest};
}

std::string_view name(FilterTarget target) { return word_of(target); }

}  // namespace billow::sim
