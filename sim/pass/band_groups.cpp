// Groups of equal numbers -> one place.
#include "sim/pass/band_groups.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace billow::sim {

namespace {

bool rows_are_uniform(const double* value, std::size_t rows) {
  for (; rows > 0; --rows, value += band_group)
    if (!std::all_of(value, value + band_group, [value](double other) { return other == *value; })) return false;
  return true;
}

}  // namespace

void share_equal_groups(const AlignedVector<double>& value, std::size_t rows, std::span<BandGroup> groups) {
  const std::size_t size = rows * band_group * sizeof(double);
  std::unordered_map<std::string_view, std::size_t> first;  // by the numbers' bytes
  for (BandGroup& group : groups) {
    const double* const own = value.data() + group.begin;
    group.uniform = rows_are_uniform(own, rows);
    const std::string_view bytes(reinterpret_cast<const char*>(own), size);
    group.begin = first.try_emplace(bytes, group.begin).first->second;
  }
}

}  // namespace billow::sim
