// The headers of NumPy's arrays.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace billow {

/// What an array of format 1.0 begins with: `type` as NumPy writes it ("<f8"), its sizes (none: one number), and
/// whether the first of them runs fastest. The numbers follow, little-endian.
std::string npy_header(std::string_view type, const std::vector<long>& shape, bool first_runs_fastest);

}  // namespace billow
