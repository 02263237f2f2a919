// The host's name, the boot's identity and the namespace of process numbers.
#include "base/process_space.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"
#include "base/regular_file.h"

namespace billow {

namespace {

std::string boot() {
  constexpr std::size_t most = 4 << 10;
  try {
    const std::string text = read_regular_file("/proc/sys/kernel/random/boot_id", most);
    return plain_ascii(std::string_view(text).substr(0, text.find('\n')));
  } catch (const InputError&) {
    return "?";
  }
}

}  // namespace

std::string plain_ascii(std::string_view text) {
  std::string out(text.substr(0, 255));
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "?";
  return plain_ascii(name.data());
}

std::string process_space() {
  std::array<char, 64> name{};
  const ssize_t size = readlink("/proc/self/ns/pid", name.data(), name.size());
  return fmt::format("{}/{}/{}", host_name(), boot(),
                     plain_ascii({name.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))}));
}

}  // namespace billow
