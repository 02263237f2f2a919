// A short fingerprint of what went into a run.
#include "cli/scene/hash.h"

#include <fmt/format.h>

#include <fstream>
#include <vector>

#include "base/error.h"

namespace billow::cli {

void Hash::mix(std::string_view bytes) {
  for (const char c : bytes) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
}

// Byte by byte from the lowest, so that the hash is the same on every machine.
void Hash::mix_length(std::uint64_t length) {
  for (int shift = 0; shift < 64; shift += 8) {
    const char byte = static_cast<char>(length >> shift & 0xff);
    mix({&byte, 1});
  }
}

void Hash::add(std::string_view bytes) {
  mix_length(bytes.size());
  mix(bytes);
}

void Hash::add_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> buffer(1 << 16);
  std::uint64_t length = 0;
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const auto count = static_cast<std::size_t>(stream.gcount());
    mix({buffer.data(), count});
    length += count;
  }
  if (!stream.eof()) throw InputError(file.string() + ": cannot be read");
  mix_length(length);
}

std::string Hash::hex() const { return fmt::format("{:016x}", value_); }

}  // namespace billow::cli
