// Text files that users write: read whole, and only if they are text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace billow::cli {

/// The file's bytes. Throws InputError on a file that is missing, no regular file, unreadable or larger than
/// `max_bytes`; nothing of a file that is too large is read.
std::string read_text_file(const std::filesystem::path& file, std::uintmax_t max_bytes);

/// The same of standard input, up to its end; messages call it <stdin>.
std::string read_standard_input(std::uintmax_t max_bytes);

/// Offset of the first byte that is not UTF-8 text: malformed UTF-8, or a control character other than tab, line feed
/// and carriage return.
std::optional<std::size_t> find_non_text(std::string_view bytes);

/// Throws InputError "NAME:LINE:COLUMN: …" unless `bytes` is UTF-8 text.
void check_utf8_text(std::string_view bytes, const std::string& name);

/// Number of characters (code points) in UTF-8 text.
std::size_t character_count(std::string_view text);

/// Whether `text` can be part of a file's name anywhere: 1 to 64 ASCII letters, digits, _ and -.
bool is_file_name(std::string_view text);

/// `name` with its ASCII capitals in lower case: names that some file systems take for the same are the same.
std::string lower_case(std::string name);

/// At most 40 characters of `text`, with "..." for what is left out: how messages quote the user.
std::string shortened(std::string_view text);

/// The characters of `text` around its byte `place`, 20 on either side, with "…" for what is left out.
std::string shortened_around(std::string_view text, std::size_t place);

}  // namespace billow::cli
