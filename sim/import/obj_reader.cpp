// Two passes over the lines: faces may name vertices that come later.
#include "sim/import/obj_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "sim/import/mesh_folder.h"
#include "sim/import/mesh_text.h"
#include "sim/import/mtl_reader.h"
#include "sim/import/soup_builder.h"
#include "sim/import/text_lines.h"

namespace billow::sim {
namespace {

[[noreturn]] void fail(int line, const std::string& reason) {
  throw InputError(fmt::format("line {}: {}", line, reason));
}

double finite_number(std::string_view word, int line) {
  double value = 0.0;
  try {
    value = number_in(word);
  } catch (const InputError& error) {
    fail(line, error.what());
  }
  if (!std::isfinite(value)) fail(line, fmt::format("'{}' is not a finite number", word));
  return value;
}

// The v, vt and mtllib lines.
class VertexPass {
 public:
  VertexPass(SoupBuilder& builder, const MeshFolder& folder) : builder_(builder), folder_(folder) {}

  void take(const TextLine& line) {
    const std::vector<std::string_view>& words = line.words;
    if (words[0] == "v") add_vertex(words, line.number);
    if (words[0] == "vt") add_texture(words, line.number);
    if (words[0] == "mtllib") add_library(std::string(line.rest));
  }

  // Colours are fractions, or bytes where any is above 1.
  void finish() {
    float largest = 1.0f;
    for (const auto& [vertex, colour] : colour_) largest = std::max(largest, colour.maxCoeff());
    for (const auto& [vertex, colour] : colour_)
      builder_.set_colour(vertex, largest > 1.0f ? Eigen::Vector3f(colour / 255.0f) : colour);
  }

  // name -> number in the builder
  const std::map<std::string, int>& materials() const { return material_; }

 private:
  // x y z, perhaps w to divide by, or r g b.
  void add_vertex(const std::vector<std::string_view>& words, int line) {
    if (words.size() < 4) fail(line, "a vertex needs three coordinates");
    double value[7] = {};
    for (std::size_t k = 1; k < words.size() && k <= 7; ++k) value[k - 1] = finite_number(words[k], line);
    const double w = (words.size() == 5 || words.size() == 8) && value[3] != 0.0 ? value[3] : 1.0;
    const int vertex = builder_.add_vertex(Eigen::Vector3d(value[0], value[1], value[2]) / w);
    const double* colour = words.size() == 7 ? value + 3 : words.size() == 8 ? value + 4 : nullptr;
    if (colour) colour_.emplace_back(vertex, Eigen::Vector3d(colour).cast<float>());
  }

  void add_texture(const std::vector<std::string_view>& words, int line) {
    float value[2] = {0.0f, 0.0f};
    for (std::size_t k = 1; k < words.size(); ++k) {
      const double given = finite_number(words[k], line);
      if (k <= 2) value[k - 1] = static_cast<float>(given);
    }
    builder_.add_texture({value[0], value[1]});
  }

  static std::string_view reason_without(MeshFolder::Answer answer) {
    switch (answer) {
      case MeshFolder::Answer::outside:
        return "it is outside the mesh's folder";
      case MeshFolder::Answer::link_outside:
        return "it is a link that leads out of the mesh's folder";
      case MeshFolder::Answer::too_large:
        return "it is too large";
      default:
        return "there is no such file";
    }
  }

  // One file whose name may have blanks, or several.
  void add_library(const std::string& names) {
    std::vector<std::string> files{names};
    if (folder_.ask(names) == MeshFolder::Answer::missing) {
      files.clear();
      for (TextWords words(names, '\0'); words.more();) files.emplace_back(words.next());
    }
    for (const std::string& file : files) {
      if (const MeshFolder::Answer answer = folder_.ask(file); answer != MeshFolder::Answer::allowed) {
        builder_.ignore(fmt::format("material library '{}' ({})", file, reason_without(answer)));
        continue;
      }
      for (Material& material : read_mtl(folder_.read(file), [&](const std::string& what) { builder_.ignore(what); }))
        material_.emplace(material.name, builder_.add_material(material));
    }
  }

  SoupBuilder& builder_;
  const MeshFolder& folder_;
  std::vector<std::pair<int, Eigen::Vector3f>> colour_;
  std::map<std::string, int> material_;
};

// The f lines, and the names that hold for them.
class FacePass {
 public:
  FacePass(SoupBuilder& builder, const std::map<std::string, int>& materials)
      : builder_(builder), materials_(materials) {}

  void take(const TextLine& line) {
    const std::vector<std::string_view>& words = line.words;
    const std::string_view key = words[0];
    if (key == "v") ++vertices_so_far_;
    if (key == "vt") ++textures_so_far_;
    if (key == "f" || key == "fo") add_face(words, line.number);
    if (key == "g" || key == "o" || key == "usemtl") take_names(line);
    if (key == "l" || key == "p") builder_.ignore(key == "l" ? "lines" : "points");
    if (!is_known(key)) builder_.ignore(fmt::format("lines that begin with '{}'", key.substr(0, 40)));
    if (key == "curv" || key == "curv2" || key == "surf") has_free_form_ = true;
  }

  void finish() {
    if (has_free_form_ && builder_.faces() == 0)
      throw InputError("it has free-form curves or surfaces and no polygons; export it as polygons");
    if (has_free_form_) builder_.ignore("free-form curves and surfaces");
    for (const auto& [name, members] : group_)
      for (const int member : members) builder_.add_member(name, member);
  }

 private:
  // Of Wavefront's format, version 3.0: what a damaged keyword loses is told.
  static bool is_known(std::string_view key) {
    static const std::set<std::string_view> known = {
        "v",     "vt",       "vn",       "vp",     "f",          "fo",        "l",      "p",     "g",    "o",
        "s",     "mg",       "usemtl",   "mtllib", "usemap",     "maplib",    "cstype", "deg",   "bmat", "step",
        "curv",  "curv2",    "surf",     "parm",   "trim",       "hole",      "scrv",   "sp",    "end",  "con",
        "bevel", "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj", "ctech",  "stech", "call", "csh"};
    return known.contains(key);
  }

  // A number of a corner, counted from 0; -1 in the file is the latest one.
  static long long absolute(long long index, int so_far) { return index > 0 ? index - 1 : so_far + index; }

  long long vertex_of(std::string_view corner, int line) const {
    long long index = 0;
    const auto [end, error] = std::from_chars(corner.data(), corner.data() + corner.size(), index);
    const bool ends = end == corner.data() + corner.size() || *end == '/';
    if (error != std::errc() || index == 0 || !ends)
      fail(line, fmt::format("face corner '{}' names no vertex", corner.substr(0, 40)));
    const long long vertex = absolute(index, vertices_so_far_);
    if (vertex < 0) fail(line, fmt::format("face uses vertex {}, but only {} come before it", index, vertices_so_far_));
    if (vertex >= builder_.vertices())
      fail(line, fmt::format("face uses vertex {}, but the file has {}", vertex + 1, builder_.vertices()));
    return vertex;
  }

  // The texture coordinate after a corner's first slash; -1: none that is there.
  long long texture_of(std::string_view corner) const {
    const std::size_t slash = corner.find('/');
    if (slash == corner.npos) return -1;
    long long index = 0;
    const auto [end, error] = std::from_chars(corner.data() + slash + 1, corner.data() + corner.size(), index);
    if (error != std::errc() || index == 0) return -1;
    const long long texture = absolute(index, textures_so_far_);
    return texture < builder_.textures() ? std::max(texture, -1ll) : -1;
  }

  void add_face(const std::vector<std::string_view>& words, int line) {
    polygon_ = {};
    polygon_.material = material_number_;
    polygon_.line = line;
    for (std::size_t k = 1; k < words.size(); ++k) {
      polygon_.corner.push_back(vertex_of(words[k], line));
      polygon_.texture.push_back(texture_of(words[k]));
    }
    // A face has a texture coordinate that exists at every corner, or none.
    const auto& texture = polygon_.texture;
    if (std::find(texture.begin(), texture.end(), -1) != texture.end()) {
      polygon_.texture.clear();
      if (builder_.textures() > 0)
        builder_.ignore("texture coordinates of faces that do not have them at every corner");
    }
    if (polygon_.corner.size() < 3) builder_.ignore("faces with fewer than three corners");
    builder_.add_polygon(polygon_);
    if (joined_.empty()) find_joined();
    for (std::vector<int>* members : joined_)
      for (const long long vertex : polygon_.corner) members->push_back(static_cast<int>(vertex));
  }

  void take_names(const TextLine& line) {
    joined_.clear();
    if (line.words[0] == "g") {
      of_group_.assign(line.words.begin() + 1, line.words.end());
      if (of_group_.size() > 1) of_group_.emplace_back(line.rest);
    } else if (line.words[0] == "o") {
      object_ = line.rest;
    } else {
      material_ = line.rest;
      const auto found = materials_.find(material_);
      material_number_ = found == materials_.end() ? -1 : found->second;
      if (found == materials_.end() && !materials_.empty())
        builder_.ignore(fmt::format("material '{}' (its libraries do not define it)", material_));
    }
  }

  // The members of all names that hold now. Names without a face after them are no groups.
  void find_joined() {
    std::set<std::string> names(of_group_.begin(), of_group_.end());
    names.insert({object_, material_});
    for (const std::string& name : names)
      if (!name.empty()) joined_.push_back(&group_[name]);
  }

  SoupBuilder& builder_;
  const std::map<std::string, int>& materials_;
  int vertices_so_far_ = 0, textures_so_far_ = 0;
  bool has_free_form_ = false;
  SoupBuilder::Polygon polygon_;
  std::map<std::string, std::vector<int>> group_;
  std::vector<std::vector<int>*> joined_;
  std::vector<std::string> of_group_;
  std::string object_, material_;
  int material_number_ = -1;
};

}  // namespace

PolygonSoup read_obj(const std::filesystem::path& file, const ImportLimits& limits) {
  const std::string text = plain_text(read_bytes(file));
  const MeshFolder folder(file, limits.max_file_bytes);
  SoupBuilder builder(limits);
  VertexPass vertices(builder, folder);
  for (TextLines lines(text); lines.next();) vertices.take(lines.line());
  vertices.finish();
  FacePass faces(builder, vertices.materials());
  for (TextLines lines(text); lines.next();) faces.take(lines.line());
  faces.finish();
  return builder.soup();
}

}  // namespace billow::sim
