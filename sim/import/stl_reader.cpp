// solid, facet, loop, three vertices, and the same three ends.
#include "sim/import/stl_reader.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "base/error.h"
#include "sim/import/byte_reader.h"
#include "sim/import/mesh_claims.h"
#include "sim/import/mesh_text.h"
#include "sim/import/soup_builder.h"
#include "sim/import/text_lines.h"

namespace billow::sim {
namespace {

constexpr std::size_t binary_header = 84, binary_triangle = 50;

std::string lower(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::uint32_t binary_count(const std::string& bytes) {
  return ByteReader(std::string_view(bytes).substr(80), std::endian::little).take<std::uint32_t>();
}

class TextStl {
 public:
  explicit TextStl(const ImportLimits& limits) : builder_(limits) {}

  void take(const TextLine& line) {
    const std::string key = lower(line.words[0]);
    if (key == "solid") name_ = line.rest, open_ = true;
    if (key == "endsolid" || key == "end") open_ = false;  // "end solid" is written too
    if (key == "vertex") add_vertex(line);
    if (key == "endloop" || key == "endfacet") end_facet(line.number);
  }

  PolygonSoup soup() {
    if (open_ || !corner_.empty())
      throw InputError(fmt::format("it ends without 'endsolid' after {} facets; it is truncated, export it again",
                                   builder_.faces()));
    return builder_.soup();
  }

 private:
  void add_vertex(const TextLine& line) {
    if (line.words.size() != 4) throw InputError(fmt::format("line {}: a vertex needs three coordinates", line.number));
    Eigen::Vector3d place;
    try {
      for (std::size_t k = 0; k < 3; ++k) place(static_cast<int>(k)) = number_in(line.words[k + 1]);
    } catch (const InputError& error) {
      throw InputError(fmt::format("line {}: {}", line.number, error.what()));
    }
    corner_.push_back(builder_.add_vertex(place));
    if (!name_.empty()) builder_.add_member(name_, builder_.vertices() - 1);
  }

  void end_facet(int line) {
    if (corner_.empty()) return;
    if (corner_.size() < 3) throw InputError(fmt::format("line {}: a facet has {} vertices", line, corner_.size()));
    builder_.add_polygon({.corner = corner_, .line = line});
    corner_.clear();
  }

  SoupBuilder builder_;
  std::string name_;
  bool open_ = false;  // a solid that has not ended
  std::vector<long long> corner_;
};

}  // namespace

bool is_text_stl(const std::string& bytes) {
  if (bytes.size() >= binary_header && bytes.size() == binary_header + binary_triangle * binary_count(bytes))
    return false;
  const std::string head = lower(plain_text(bytes.substr(0, 1000)));
  const std::size_t begin = head.find_first_not_of(" \t\n");
  return begin != head.npos && head.compare(begin, 5, "solid") == 0 && head.find('\0') == head.npos;
}

void check_binary_stl(const std::string& bytes, const ImportLimits& limits) {
  if (bytes.size() < binary_header)
    throw InputError("it is neither text, which begins with 'solid', nor long enough to be binary; it is no STL file");
  const std::uint32_t count = binary_count(bytes);
  check_claim("faces", count, limits.max_faces, bytes.size());
  if (bytes.size() < binary_header + binary_triangle * count)
    throw InputError(fmt::format(
        "its header claims {} faces, but the file has room for {}; it is truncated or broken, export it again", count,
        (bytes.size() - binary_header) / binary_triangle));
}

PolygonSoup read_text_stl(std::string bytes, const ImportLimits& limits) {
  const std::string text = plain_text(std::move(bytes));
  TextStl stl(limits);
  for (TextLines lines(text); lines.next();) stl.take(lines.line());
  return stl.soup();
}

}  // namespace billow::sim
