// Header, then what was spooled.
#include "base/npy_file.h"

#include <stdexcept>

#include "base/atomic_file.h"
#include "base/npy.h"

namespace billow {

void NpyFile::append(const void* numbers, std::size_t bytes) {
  spool_.append(numbers, bytes);
  bytes_ += bytes;
}

void NpyFile::finish(const std::vector<long>& shape) const {
  std::size_t expected = static_cast<std::size_t>(type_.back() - '0');
  for (const long size : shape) expected *= static_cast<std::size_t>(size);
  if (expected != bytes_) throw std::logic_error("an array has not the size of its shape");
  AtomicFile output(file_);
  output.append(npy_header(type_, shape, false));
  spool_.copy_to(output, bytes_);
  output.commit();
}

}  // namespace billow
