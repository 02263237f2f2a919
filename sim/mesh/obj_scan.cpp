// A light second reading of an OBJ file. Only what assimp does not tell is taken from it; faces and texture coordinates
// still come from assimp.
#include "sim/mesh/obj_scan.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "sim/mesh/distinct_positions.h"

namespace billow::sim {
namespace {

constexpr std::string_view blanks = " \t\r";

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (std::size_t at = 0; (at = line.find_first_not_of(blanks, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
}

void sort_and_unite(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// Reads line by line and collects; every fault is thrown with the line it is on.
class Scanner {
 public:
  explicit Scanner(ObjVertices& found) : found_(found) {}

  void scan(std::string_view line, int line_number) {
    line_ = line_number;
    split_words(line.substr(0, line.find('#')), words_);
    const std::vector<std::string_view>& words = words_;
    if (words.empty()) return;
    if (words[0] == "v") add_vertex(words);
    if (words[0] == "vt") add_texture(words);
    if (words[0] == "f") add_face(words);
    if (words[0] == "g" || words[0] == "o" || words[0] == "usemtl") take_names(words);
  }

  // Faces may name vertices that come later, so their range is known only at the end.
  void finish() {
    if (highest_ >= static_cast<long>(found_.position.size()))
      fail(highest_line_,
           fmt::format("face uses vertex {}, but the file has {}", highest_ + 1, found_.position.size()));
    for (auto& [name, members] : found_.group) sort_and_unite(members);
    forget_bad_texture();
  }

 private:
  [[noreturn]] static void fail(int line, const std::string& reason) {
    throw InputError(fmt::format("line {}: {}", line, reason));
  }

  double number(std::string_view word) const {
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
    // assimp drops a line that begins a number so, and every later vertex would take another's place.
    if (digits.starts_with('.')) fail(line_, fmt::format("'{0}' has no digit before its point; write 0{0}", word));
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size() || (error != std::errc() && error != std::errc::result_out_of_range))
      fail(line_, fmt::format("'{}' is not a number{}", word,
                              word.find(',') != word.npos ? "; write decimals with a point" : ""));
    if (error == std::errc() && !std::isfinite(value)) fail(line_, fmt::format("'{}' is not a finite number", word));
    return value;
  }

  // x y z, perhaps w to divide by, or r g b.
  void add_vertex(const std::vector<std::string_view>& words) {
    if (words.size() < 4) fail(line_, "a vertex needs three coordinates");
    double value[4];
    for (std::size_t k = 1; k < words.size(); ++k) value[std::min<std::size_t>(k - 1, 3)] = number(words[k]);
    const double w = words.size() == 5 && value[3] != 0.0 ? value[3] : 1.0;
    found_.position.emplace_back(value[0] / w, value[1] / w, value[2] / w);
  }

  void add_texture(const std::vector<std::string_view>& words) {
    float value[2] = {0.0f, 0.0f};
    for (std::size_t k = 1; k < words.size(); ++k) {
      const double given = number(words[k]);
      if (k <= 2) value[k - 1] = static_cast<float>(given);
    }
    found_.uv.emplace_back(value[0], value[1]);
  }

  // The vertex number in front of a corner's first slash, counted from 0; -1 in the file is the latest vertex.
  long corner_vertex(std::string_view corner) const {
    long index = 0;
    const auto [end, error] = std::from_chars(corner.data(), corner.data() + corner.size(), index);
    if (error != std::errc() || index == 0) fail(line_, fmt::format("face corner '{}' names no vertex", corner));
    const long vertex = index > 0 ? index - 1 : static_cast<long>(found_.position.size()) + index;
    if (vertex < 0)
      fail(line_, fmt::format("face uses vertex {}, but only {} come before it", index, found_.position.size()));
    return vertex;
  }

  // The texture coordinate after a corner's first slash, counted from 0; -1: none that can be.
  int corner_texture(std::string_view corner) const {
    const std::size_t slash = corner.find('/');
    if (slash == corner.npos) return -1;
    int index = 0;
    const auto [end, error] = std::from_chars(corner.data() + slash + 1, corner.data() + corner.size(), index);
    if (error != std::errc()) return -1;
    return std::max(-1, index > 0 ? index - 1 : static_cast<int>(found_.uv.size()) + index);
  }

  // As assimp_reader cuts polygons.
  void add_polygon(const std::vector<int>& vertex, const std::vector<int>& texture) {
    const std::size_t corners = vertex.size();
    if (corners == 4) {
      found_.face.push_back({vertex[0], vertex[1], vertex[2], vertex[3]});
      found_.uv_corner.push_back({texture[0], texture[1], texture[2], texture[3]});
    }
    for (std::size_t k = 2; corners != 4 && k < corners; ++k) {
      found_.face.push_back({vertex[0], vertex[k - 1], vertex[k], -1});
      found_.uv_corner.push_back({texture[0], texture[k - 1], texture[k], -1});
    }
  }

  // A face has a texture coordinate that exists at every corner, or none. They, too, may come later.
  void forget_bad_texture() {
    const int count = static_cast<int>(found_.uv.size());
    for (Face& texture : found_.uv_corner) {
      const int corners = corner_count(found_.face[&texture - found_.uv_corner.data()]);
      const auto bad = [&](int t) { return t < 0 || t >= count; };
      if (std::any_of(texture.begin(), texture.begin() + corners, bad)) texture.fill(-1);
    }
  }

  void add_face(const std::vector<std::string_view>& words) {
    if (joined_.empty()) find_joined();
    std::vector<int> corner, texture;
    for (std::size_t k = 1; k < words.size(); ++k) {
      const long vertex = corner_vertex(words[k]);
      corner.push_back(static_cast<int>(vertex));
      texture.push_back(corner_texture(words[k]));
      if (vertex > highest_) {
        highest_ = vertex;
        highest_line_ = line_;
      }
      for (std::vector<int>* members : joined_) members->push_back(static_cast<int>(vertex));
    }
    add_polygon(corner, texture);
  }

  void take_names(const std::vector<std::string_view>& words) {
    joined_.clear();
    if (words[0] == "g")
      group_.assign(words.begin() + 1, words.end());
    else
      (words[0] == "o" ? object_ : material_) = words.size() > 1 ? words[1] : std::string_view();
  }

  // The members of all names that hold now. Names without a face after them are no groups.
  void find_joined() {
    std::vector<std::string> names = group_;
    names.insert(names.end(), {object_, material_});
    for (const std::string& name : names)
      if (!name.empty()) joined_.push_back(&found_.group[name]);
  }

  ObjVertices& found_;
  int line_ = 0;
  std::vector<std::string_view> words_;  // of the line
  std::vector<std::vector<int>*> joined_;
  std::vector<std::string> group_;
  std::string object_, material_;
  long highest_ = -1;
  int highest_line_ = 0;
};

// The next line without its end, lines that a backslash continues joined; counts the file's lines.
bool next_line(std::istream& in, std::string& line, int& line_number) {
  line.clear();
  for (std::string part; std::getline(in, part);) {
    ++line_number;
    if (part.ends_with('\r')) part.pop_back();
    line += part;
    if (!line.ends_with('\\')) return true;
    line.back() = ' ';
  }
  return !line.empty();
}

// Assimp reads single precision, with an error of a few units in the last place of the largest coordinate.
double reading_error(const std::vector<Eigen::Vector3d>& position) {
  double largest = 0.0;
  for (const Eigen::Vector3d& p : position) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest > 0.0 ? 1e-6 * largest : 1.0;
}

// Raw vertices of `soup` in the order `source`: row k of the result is row source[k].
PolygonSoup permuted(const PolygonSoup& soup, const std::vector<int>& source) {
  std::vector<int> place(source.size());
  for (std::size_t k = 0; k < source.size(); ++k) place[source[k]] = static_cast<int>(k);
  PolygonSoup result;
  result.position = soup.position(source, Eigen::all);
  if (soup.uv.rows() > 0) result.uv = soup.uv(source, Eigen::all);
  if (soup.colour.rows() > 0) result.colour = soup.colour(source, Eigen::all);
  result.face = soup.face;
  for (Face& face : result.face)
    for (int c = 0; c < corner_count(face); ++c) face[c] = place[face[c]];
  return result;
}

std::vector<int> all_copies(const std::vector<int>& vertices, const std::vector<int>& number_of_vertex,
                            const std::vector<std::vector<int>>& copies) {
  std::vector<int> rows;
  for (const int v : vertices) {
    const std::vector<int>& of_vertex = copies[number_of_vertex[v]];
    rows.insert(rows.end(), of_vertex.begin(), of_vertex.end());
  }
  sort_and_unite(rows);
  return rows;
}

// The layout that the file has, of raw vertices: a vertex becomes the first of its copies.
FileLayout layout_of(const ObjVertices& vertices, const std::vector<int>& number_of_vertex,
                     const std::vector<std::vector<int>>& copies) {
  FileLayout layout;
  std::vector<Eigen::Vector3d> loose;
  for (std::size_t v = 0; v < vertices.position.size(); ++v) {
    const std::vector<int>& raw = copies[number_of_vertex[v]];
    layout.vertex.push_back(raw.empty() ? -1 : raw.front());
    if (raw.empty()) loose.push_back(vertices.position[v]);
  }
  layout.loose.resize(static_cast<Eigen::Index>(loose.size()), 3);
  for (std::size_t k = 0; k < loose.size(); ++k) layout.loose.row(static_cast<Eigen::Index>(k)) = loose[k];
  layout.face = vertices.face;
  layout.uv.resize(static_cast<Eigen::Index>(vertices.uv.size()), 2);
  for (std::size_t k = 0; k < vertices.uv.size(); ++k) layout.uv.row(static_cast<Eigen::Index>(k)) = vertices.uv[k];
  if (!vertices.uv.empty()) layout.uv_corner = vertices.uv_corner;
  return layout;
}

}  // namespace

ObjVertices scan_obj(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError("it cannot be opened; check its permissions");
  ObjVertices found;
  Scanner scanner(found);
  std::string line;
  for (int line_number = 0; next_line(in, line, line_number);) scanner.scan(line, line_number);
  scanner.finish();
  return found;
}

PolygonSoup in_file_order(const PolygonSoup& soup, const ObjVertices& vertices) {
  if (vertices.position.empty()) return soup;
  DistinctPositions distinct(vertices.position.front(), reading_error(vertices.position));
  std::vector<int> number_of_vertex;  // distinct positions are numbered as the file first names them
  for (const Eigen::Vector3d& p : vertices.position) number_of_vertex.push_back(distinct.find_or_add(p));
  std::vector<int> number_of_raw;
  for (Eigen::Index r = 0; r < soup.position.rows(); ++r) number_of_raw.push_back(distinct.find(soup.position.row(r)));

  std::vector<int> order(number_of_raw.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return number_of_raw[a] < number_of_raw[b]; });
  PolygonSoup ordered = permuted(soup, order);

  std::vector<std::vector<int>> copies(number_of_vertex.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    if (const int number = number_of_raw[order[k]]; number >= 0) copies[number].push_back(static_cast<int>(k));
  for (const auto& [name, members] : vertices.group)
    ordered.group[name] = all_copies(members, number_of_vertex, copies);
  ordered.layout = layout_of(vertices, number_of_vertex, copies);
  return ordered;
}

}  // namespace billow::sim
