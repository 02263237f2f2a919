// Header, then what was spooled.
#include "base/npy_file.h"

#include <algorithm>
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
  const std::string header = npy_header(type_, shape, false);
  if (!output.write(header.data(), header.size())) output.fail();
  std::vector<char> block(std::size_t{1} << 16);
  for (std::size_t at = 0; at < bytes_; at += block.size()) {
    const std::size_t size = std::min(block.size(), bytes_ - at);
    spool_.read(block.data(), size, at);
    if (!output.write(block.data(), size)) output.fail();
  }
  output.commit();
}

}  // namespace billow
