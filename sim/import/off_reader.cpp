// The words of an OFF file do not tell how many numbers a vertex or a face has: colours are optional, and some programs
// write them unannounced. Each layout that is possible is tried, the likeliest first, and the one that uses up the file
// to its last word is right.
#include "sim/import/off_reader.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "sim/import/byte_reader.h"
#include "sim/import/mesh_claims.h"
#include "sim/import/mesh_folder.h"
#include "sim/import/mesh_text.h"
#include "sim/import/soup_builder.h"

namespace billow::sim {
namespace {

// What the keyword says.
struct OffHeader {
  bool texture = false, colours = false, normals = false, homogeneous = false;
  int dimensions = 3;
  bool binary = false;
  std::size_t length = 0;  // of the header in bytes
};

// How the rest is laid out, as far as the keyword does not say.
struct Layout {
  bool edge_count = true;
  int colour_numbers = 0;             // after each vertex
  std::optional<int> face_colours{};  // numbers after each face; none: what is left of its line
};

bool takes(std::string_view& word, std::string_view prefix) {
  if (!word.starts_with(prefix)) return false;
  word.remove_prefix(prefix.size());
  return true;
}

bool begins_number(std::string_view word) {
  return !word.empty() && (word[0] == '-' || word[0] == '+' || word[0] == '.' || (word[0] >= '0' && word[0] <= '9'));
}

OffHeader read_header(const std::string& text) {
  OffHeader header;
  TextWords words(text);
  std::string_view word = words.next();
  if (!word.ends_with("OFF") && begins_number(word)) return header;  // the keyword may be missing
  header.texture = takes(word, "ST");
  header.colours = takes(word, "C");
  header.normals = takes(word, "N");
  header.homogeneous = takes(word, "4");
  const bool any_dimension = takes(word, "n");
  if (word != "OFF") throw InputError("it begins with neither OFF nor a count of vertices; it is no OFF file");
  header.length = words.passed();
  if (words.more_on_line() && words.next() == "BINARY") {
    header.binary = true;
    header.length = words.passed() + 1;
  } else if (any_dimension) {
    words = TextWords(text);
    words.next();
    header.dimensions = static_cast<int>(std::clamp(words.integer("the number of dimensions"), 0ll, 1000ll));
    header.length = words.passed();
  }
  if (header.dimensions < 1 || header.dimensions > 3)
    throw InputError(fmt::format("its vertices have {} dimensions; export it in three", header.dimensions));
  return header;
}

std::string layout_text(long long vertices, long long faces) {
  return fmt::format("it declares {} vertices and {} faces", vertices, faces);
}

// One attempt to read the words after the keyword in one layout.
class Attempt {
 public:
  Attempt(std::string_view text, const OffHeader& header, const Layout& layout, const ImportLimits& limits)
      : words_(text), bytes_(text.size()), header_(header), layout_(layout), limits_(limits), builder_(limits) {}

  PolygonSoup soup() {
    vertices_ = words_.integer("the number of vertices");
    faces_ = words_.integer("the number of faces");
    check_claim("vertices", vertices_, limits_.max_vertices, bytes_);
    check_claim("faces", faces_, limits_.max_faces, bytes_);
    if (layout_.edge_count) words_.integer("the number of edges");
    for (long long v = 0; v < vertices_; ++v) add_vertex(v);
    for (long long f = 0; f < faces_; ++f) add_face(f);
    if (words_.more()) {
      words_.next();
      throw InputError(fmt::format("line {}: {}, but more follows the last of them; its counts are wrong",
                                   words_.line(), layout_text(vertices_, faces_)));
    }
    set_colours();
    return builder_.soup();
  }

 private:
  std::string vertex_text(long long v) const { return fmt::format("a number of vertex {} of {}", v + 1, vertices_); }

  void add_vertex(long long v) {
    double value[4] = {0.0, 0.0, 0.0, 1.0};
    const std::string what = vertex_text(v);
    for (int k = 0; k < header_.dimensions; ++k) value[k] = words_.number(what);
    if (header_.homogeneous) value[3] = words_.number(what);
    if (value[3] == 0.0) throw InputError(fmt::format("line {}: vertex {} lies at infinity", words_.line(), v + 1));
    const int vertex = builder_.add_vertex(Eigen::Vector3d(value[0], value[1], value[2]) / value[3]);
    for (int k = 0; header_.normals && k < header_.dimensions; ++k) words_.number(what);
    for (int k = 0; k < layout_.colour_numbers; ++k) {
      const double number = words_.number(what);
      if (k < 3) colour_.push_back(static_cast<float>(number));
    }
    if (!header_.texture) return;
    const double s = words_.number(what);
    builder_.set_uv(vertex, {static_cast<float>(s), static_cast<float>(words_.number(what))});
  }

  void add_face(long long f) {
    const std::string what = fmt::format("the number of corners of face {} of {}", f + 1, faces_);
    const long long corners = words_.integer(what);
    if (corners < 1 || corners > vertices_ + faces_ + 64)
      throw InputError(fmt::format("line {}: {} should be here, not {}", words_.line(), what, corners));
    polygon_.corner.clear();
    for (long long c = 0; c < corners; ++c) polygon_.corner.push_back(words_.integer("a corner of a face"));
    if (corners < 3) builder_.ignore("faces with fewer than three corners");
    polygon_.line = words_.line();
    builder_.add_polygon(polygon_);
    skip_colours();
  }

  void skip_colours() {
    int count = 0;
    const bool to_line_end = !layout_.face_colours;
    while (to_line_end ? words_.more_on_line() : count < *layout_.face_colours) {
      if (!words_.more_on_line()) throw InputError(fmt::format("line {}: a face lacks its colours", words_.line()));
      words_.number("a colour of a face");
      if (++count > 4) throw InputError(fmt::format("line {}: a face has more than four colours", words_.line()));
    }
    if (count > 0) builder_.ignore("colours of faces");
  }

  // Colours are fractions, or bytes where any is above 1.
  void set_colours() {
    if (colour_.empty()) return;
    const float unit = *std::max_element(colour_.begin(), colour_.end()) > 1.0f ? 255.0f : 1.0f;
    for (int v = 0; v < builder_.vertices(); ++v)
      builder_.set_colour(v, Eigen::Vector3f(&colour_[3 * static_cast<std::size_t>(v)]) / unit);
  }

  TextWords words_;
  std::size_t bytes_;
  const OffHeader& header_;
  const Layout& layout_;
  const ImportLimits& limits_;
  SoupBuilder builder_;
  long long vertices_ = 0, faces_ = 0;
  std::vector<float> colour_;  // three per vertex
  SoupBuilder::Polygon polygon_;
};

// Whether the line of counts has two numbers only.
bool lacks_edge_count(std::string_view text) {
  TextWords words(text);
  words.next();
  if (!words.more_on_line()) return false;
  words.next();
  return !words.more_on_line();
}

std::vector<Layout> layouts(std::string_view text, const OffHeader& header) {
  const bool lacks = lacks_edge_count(text);
  const std::vector<int> colours = header.colours ? std::vector<int>{4, 3} : std::vector<int>{0, 4, 3};
  std::vector<Layout> all;
  for (const bool edge_count : {!lacks, lacks})
    for (const int numbers : colours)
      for (const std::optional<int> face : {std::optional<int>(), {0}, {3}, {4}, {1}})
        all.push_back({edge_count, numbers, face});
  return all;
}

PolygonSoup read_text(std::string_view text, const OffHeader& header, const ImportLimits& limits) {
  std::optional<InputError> first;
  for (const Layout& layout : layouts(text, header)) {
    try {
      return Attempt(text, header, layout, limits).soup();
    } catch (const InputError& error) {
      if (!first) first = error;
    }
  }
  throw InputError(*first);
}

PolygonSoup read_binary(std::string_view bytes, const OffHeader& header, const ImportLimits& limits) {
  ByteReader reader(bytes, std::endian::big);
  SoupBuilder builder(limits);
  const auto vertices = reader.take<std::int32_t>(), faces = reader.take<std::int32_t>();
  reader.take<std::int32_t>();  // edges
  check_claim("vertices", vertices, limits.max_vertices, bytes.size());
  check_claim("faces", faces, limits.max_faces, bytes.size());
  const auto numbers = [&](int count, float* out) {
    for (int k = 0; k < count; ++k) out[k] = reader.take<float>();
  };
  for (int v = 0; v < vertices; ++v) {
    float place[4] = {0, 0, 0, 1}, normal[3], colour[4], texture[2];
    numbers(header.dimensions, place);
    if (header.homogeneous) numbers(1, place + 3);
    builder.add_vertex(Eigen::Vector3f(place).cast<double>() / place[3]);
    if (header.normals) numbers(header.dimensions, normal);
    if (header.colours) numbers(4, colour), builder.set_colour(v, Eigen::Vector3f(colour));
    if (header.texture) numbers(2, texture), builder.set_uv(v, {texture[0], texture[1]});
  }
  for (int f = 0; f < faces; ++f) {
    const auto corners = reader.take<std::int32_t>();
    check_claim("corners of a face", corners, limits.max_vertices, reader.left());
    SoupBuilder::Polygon polygon;
    for (int c = 0; c < corners; ++c) polygon.corner.push_back(reader.take<std::int32_t>());
    builder.add_polygon(polygon);
    const auto colours = reader.take<std::int32_t>();
    if (colours != 0) builder.ignore("colours of faces");
    for (int k = 0; k < colours; ++k) reader.take<float>();
  }
  return builder.soup();
}

}  // namespace

PolygonSoup read_off(const std::filesystem::path& file, const ImportLimits& limits) {
  const std::string bytes = read_bytes(file), text = plain_text(bytes);
  const OffHeader header = read_header(text);
  if (!header.binary) return read_text(std::string_view(text).substr(header.length), header, limits);
  return read_binary(std::string_view(bytes).substr(bytes.find('\n') + 1), header, limits);
}

}  // namespace billow::sim
