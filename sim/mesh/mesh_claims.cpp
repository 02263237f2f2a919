// PLY and OFF headers, read only as far as their counts.
#include "sim/mesh/mesh_claims.h"

#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "base/error.h"

namespace billow::sim {
namespace {

constexpr std::size_t max_header_bytes = 1 << 20;

std::string head_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError("it cannot be opened; check its permissions");
  std::string head(max_header_bytes, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

// A count, or the largest number there is where the text is larger still; 0 where it is no count.
long long count_in(const std::string& word) {
  long long count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  return error == std::errc::result_out_of_range ? std::numeric_limits<long long>::max() : count;
}

void check(const std::string& what, const std::string& word, long long limit, long long bytes) {
  const long long count = count_in(word);
  if (count > bytes)
    throw InputError(fmt::format("its header claims {} {}, but the file has only {} bytes; it is truncated or broken",
                                 word, what, bytes));
  if (count > limit)
    throw InputError(fmt::format("it has {} {}, and the limit is {}; use a coarser mesh", word, what, limit));
}

void check_ply(const std::string& head, const ImportLimits& limits, long long bytes) {
  // Without an end, assimp looks for one until its memory is spent.
  const std::size_t end = head.find("\nend_header");
  if (end == head.npos) throw InputError("its header has no end; it is truncated or no PLY file");
  std::istringstream words(head.substr(0, end));
  for (std::string word, name, count; words >> word;)
    if (word == "element" && words >> name >> count)
      check(name == "vertex" ? "vertices" : name + " elements", count,
            name == "vertex" ? limits.max_vertices : limits.max_faces, bytes);
}

// The first two numbers after the keyword (OFF, COFF, ST OFF ...); comments run to the end of their line.
void check_off(const std::string& head, const ImportLimits& limits, long long bytes) {
  std::istringstream lines(head);
  std::string text;
  for (std::string line; std::getline(lines, line);) text += line.substr(0, line.find('#')) + '\n';
  std::istringstream words(text);
  std::string vertices, faces;
  while (words >> vertices && vertices.find_first_not_of("0123456789") != vertices.npos) {
  }
  words >> faces;
  check("vertices", vertices, limits.max_vertices, bytes);
  check("faces", faces, limits.max_faces, bytes);
}

}  // namespace

void check_claims(const std::filesystem::path& file, const ImportLimits& limits) {
  const auto bytes = static_cast<long long>(std::filesystem::file_size(file));
  const std::string extension = file.extension().string();
  if (extension == ".ply" || extension == ".PLY") check_ply(head_of(file), limits, bytes);
  if (extension == ".off" || extension == ".OFF") check_off(head_of(file), limits, bytes);
}

}  // namespace billow::sim
