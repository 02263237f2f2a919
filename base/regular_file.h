// Files read without surprises: what is no file is refused, and nothing is waited for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace billow {

/// The file's bytes. Throws InputError "FILE: …" on one that is missing, a folder, a pipe or another thing that is no
/// file, that cannot be read, or that is larger than `max_bytes`, with `hint_when_larger` behind; nothing of a file
/// that is too large is read.
std::string read_regular_file(const std::filesystem::path& file,
                              std::uintmax_t max_bytes = std::numeric_limits<std::uintmax_t>::max(),
                              std::string_view hint_when_larger = "");

/// The last bytes of a file, at most `most`; throws the same.
std::string read_tail(const std::filesystem::path& file, std::size_t most);

}  // namespace billow
