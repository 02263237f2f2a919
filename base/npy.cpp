// Format 1.0 of numpy.lib.format.
#include "base/npy.h"

#include <fmt/format.h>

namespace billow {

std::string npy_header(std::string_view type, const std::vector<long>& shape, bool first_runs_fastest) {
  std::string sizes;
  for (const long size : shape) sizes += fmt::format("{}, ", size);
  if (shape.size() > 1) sizes.resize(sizes.size() - 2);  // only a single size keeps its comma
  if (shape.size() == 1) sizes.pop_back();
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': ({}), }}", type,
                                 first_runs_fastest ? "True" : "False", sizes);
  constexpr std::size_t before = 10, multiple = 64;  // magic, version and length; the numbers are aligned
  text.append((multiple - (before + text.size() + 1) % multiple) % multiple, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(text.size() & 0xff);
  header += static_cast<char>(text.size() >> 8);
  return header + text;
}

}  // namespace billow
