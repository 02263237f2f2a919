// A header that says what follows, and then exactly that.
#include "sim/import/ply_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "sim/import/byte_reader.h"
#include "sim/import/mesh_claims.h"
#include "sim/import/mesh_folder.h"
#include "sim/import/mesh_text.h"
#include "sim/import/soup_builder.h"

namespace billow::sim {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

struct Property {
  std::string name;
  Type type = Type::f32;
  std::optional<Type> count{};  // of a list
};

struct Element {
  std::string name;
  long long count = 0;
  std::vector<Property> property;
};

struct PlyHeader {
  enum class Format { ascii, little, big } format = Format::ascii;
  std::vector<Element> element;
  std::string texture;     // MeshLab's comment TextureFile
  std::size_t length = 0;  // in bytes
};

Type type_of(const std::string& word) {
  static const std::map<std::string, Type> types = {
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  const auto found = types.find(word);
  if (found == types.end())
    throw InputError(fmt::format("its header names the type '{}', which PLY does not have", word));
  return found->second;
}

double largest_of(Type type) {
  switch (type) {
    case Type::i8:
      return 127.0;
    case Type::u8:
      return 255.0;
    case Type::i16:
      return 32767.0;
    case Type::u16:
      return 65535.0;
    case Type::i32:
      return 2147483647.0;
    case Type::u32:
      return 4294967295.0;
    default:
      return 1.0;
  }
}

// Reads a header line by line; what follows its last line end is the data.
class HeaderReader {
 public:
  explicit HeaderReader(std::string_view bytes) : bytes_(bytes) {}

  PlyHeader header() {
    if (next_line() != "ply") throw InputError("it does not begin with 'ply'; it is no PLY file");
    while (true) {
      if (at_ >= bytes_.size()) throw InputError("its header has no end; it is truncated or no PLY file");
      const std::string line(next_line());
      if (line == "end_header") break;
      take(line);
    }
    header_.length = at_;
    return std::move(header_);
  }

 private:
  // Without the blanks around it. Lines end in \n, \r\n or \r.
  std::string_view next_line() {
    std::size_t end = at_;
    while (end < bytes_.size() && bytes_[end] != '\n' && bytes_[end] != '\r') ++end;
    std::string_view line = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    if (end < bytes_.size() && bytes_[end] == '\r' && at_ < bytes_.size() && bytes_[at_] == '\n') ++at_;
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    return line;
  }

  void take(const std::string& line) {
    std::istringstream words(line);
    std::string word, name;
    words >> word;
    if (word == "format") {
      words >> name;
      take_format(name);
    } else if (word == "comment" && words >> name && name == "TextureFile") {
      std::getline(words >> std::ws, header_.texture);
    } else if (word == "element") {
      std::string count;
      words >> name >> count;
      header_.element.push_back({name, integer_in(count), {}});
    } else if (word == "property") {
      take_property(words);
    }
  }

  void take_format(const std::string& name) {
    using Format = PlyHeader::Format;
    static const std::map<std::string, Format> formats = {
        {"ascii", Format::ascii}, {"binary_little_endian", Format::little}, {"binary_big_endian", Format::big}};
    const auto found = formats.find(name);
    if (found == formats.end()) throw InputError(fmt::format("its format '{}' is none that PLY has", name));
    header_.format = found->second;
  }

  void take_property(std::istringstream& words) {
    if (header_.element.empty()) throw InputError("its header names a property before any element");
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      std::string count;
      words >> count >> type;
      property.count = type_of(count);
    }
    property.type = type_of(type);
    words >> property.name;
    header_.element.back().property.push_back(property);
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  PlyHeader header_;
};

// The numbers after the header.
class Numbers {
 public:
  virtual ~Numbers() = default;
  virtual double take(Type type) = 0;
  virtual int line() const { return 0; }  // 0: none
  virtual std::size_t left() const = 0;
};

class TextNumbers : public Numbers {
 public:
  TextNumbers(std::string_view text, int first_line) : text_(text), words_(text, '\0', first_line) {}
  double take(Type type) override {
    const double value = words_.number("a number");
    if (type != Type::f32 && type != Type::f64 && value != std::floor(value))
      throw InputError(fmt::format("line {}: {} is not a whole number", words_.line(), value));
    return value;
  }
  int line() const override { return words_.line(); }
  std::size_t left() const override { return text_.size() - words_.passed(); }

 private:
  std::string_view text_;
  TextWords words_;
};

class BinaryNumbers : public Numbers {
 public:
  BinaryNumbers(std::string_view bytes, std::endian order) : reader_(bytes, order) {}
  double take(Type type) override {
    switch (type) {
      case Type::i8:
        return reader_.take<std::int8_t>();
      case Type::u8:
        return reader_.take<std::uint8_t>();
      case Type::i16:
        return reader_.take<std::int16_t>();
      case Type::u16:
        return reader_.take<std::uint16_t>();
      case Type::i32:
        return reader_.take<std::int32_t>();
      case Type::u32:
        return reader_.take<std::uint32_t>();
      case Type::f32:
        return reader_.take<float>();
      case Type::f64:
        return reader_.take<double>();
    }
    return 0.0;
  }
  std::size_t left() const override { return reader_.left(); }

 private:
  ByteReader reader_;
};

// What a number of a vertex is.
enum class Kind { x, y, z, u, v, red, green, blue, skip, weight };

struct Role {
  Kind kind;
  double unit = 1.0;  // divides it
};

Role role_of(const Property& property) {
  static const std::map<std::string, Kind> kinds = {{"x", Kind::x},
                                                    {"y", Kind::y},
                                                    {"z", Kind::z},
                                                    {"u", Kind::u},
                                                    {"v", Kind::v},
                                                    {"s", Kind::u},
                                                    {"t", Kind::v},
                                                    {"texture_u", Kind::u},
                                                    {"texture_v", Kind::v},
                                                    {"red", Kind::red},
                                                    {"green", Kind::green},
                                                    {"blue", Kind::blue},
                                                    {"diffuse_red", Kind::red},
                                                    {"diffuse_green", Kind::green},
                                                    {"diffuse_blue", Kind::blue},
                                                    {"r", Kind::red},
                                                    {"g", Kind::green},
                                                    {"b", Kind::blue},
                                                    {"nx", Kind::skip},
                                                    {"ny", Kind::skip},
                                                    {"nz", Kind::skip}};
  if (property.count) return {Kind::skip};
  const auto found = kinds.find(property.name);
  const Kind kind = found == kinds.end() ? Kind::weight : found->second;
  const bool colour = kind == Kind::red || kind == Kind::green || kind == Kind::blue || property.name == "alpha";
  return {kind, colour ? largest_of(property.type) : 1.0};
}

class Body {
 public:
  Body(const PlyHeader& header, Numbers& numbers, const ImportLimits& limits, std::size_t bytes)
      : header_(header), numbers_(numbers), limits_(limits), bytes_(bytes), builder_(limits) {}

  PolygonSoup soup() {
    for (const Element& element : header_.element) check(element);
    for (const Element& element : header_.element) read(element);
    if (!header_.texture.empty()) {
      Material material;
      material.texture = header_.texture;
      builder_.add_material(std::move(material));
    }
    for (const Polygon& polygon : waiting_) builder_.add_polygon(polygon);
    if (builder_.faces() == 0 && has_range_grid_)
      throw InputError("it is a grid of ranges, as scanners write them, and has no faces; triangulate it");
    return builder_.soup();
  }

 private:
  using Polygon = SoupBuilder::Polygon;

  void check(const Element& element) {
    if (element.property.empty()) return;
    const bool vertices = element.name == "vertex";
    const bool known = vertices || element.name == "face" || element.name == "tristrips";
    check_claim(vertices                 ? "vertices"
                : element.name == "face" ? "faces"
                                         : fmt::format("'{}' elements", element.name),
                element.count, vertices ? limits_.max_vertices : limits_.max_faces, bytes_);
    if (!known && element.count > 0) builder_.ignore(fmt::format("elements '{}'", element.name));
  }

  void read(const Element& element) {
    if (element.property.empty()) return;
    has_range_grid_ = has_range_grid_ || element.name == "range_grid";
    if (element.name == "vertex") return read_vertices(element);
    for (long long k = 0; k < element.count; ++k) read_lists(element);
  }

  void read_vertices(const Element& element) {
    std::vector<Role> role;
    for (const Property& property : element.property) role.push_back(role_of(property));
    const auto has = [&](Kind kind) {
      return std::any_of(role.begin(), role.end(), [&](const Role& r) { return r.kind == kind; });
    };
    for (const Kind axis : {Kind::x, Kind::y, Kind::z})
      if (!has(axis)) throw InputError("its vertices lack x, y or z; export it with positions");
    has_uv_ = has(Kind::u) && has(Kind::v);
    has_colour_ = has(Kind::red);
    for (long long v = 0; v < element.count; ++v) read_vertex(element, role);
    has_vertices_ = true;
  }

  void read_vertex(const Element& element, const std::vector<Role>& role) {
    double value[static_cast<int>(Kind::skip)] = {};
    weights_.clear();
    for (std::size_t k = 0; k < role.size(); ++k) {
      const Property& property = element.property[k];
      if (property.count) {
        take_list(property, list_);
        continue;
      }
      const double number = numbers_.take(property.type) / role[k].unit;
      if (role[k].kind < Kind::skip) value[static_cast<int>(role[k].kind)] = number;
      if (role[k].kind == Kind::weight) weights_.emplace_back(&property.name, static_cast<float>(number));
    }
    const int vertex = builder_.add_vertex({value[0], value[1], value[2]});
    const auto pair = Eigen::Vector2d(value[3], value[4]);
    if (has_uv_) builder_.set_uv(vertex, pair.cast<float>());
    if (has_colour_) builder_.set_colour(vertex, Eigen::Vector3d(value[5], value[6], value[7]).cast<float>());
    for (const auto& [name, weight] : weights_) builder_.set_weight(vertex, *name, weight);
  }

  void take_list(const Property& property, std::vector<double>& list) {
    const double count = numbers_.take(*property.count);
    if (!(count >= 0.0) || count > static_cast<double>(numbers_.left()))
      throw InputError(fmt::format(
          "{}a list '{}' of {} numbers does not fit into the file; it is truncated or broken, export it again",
          numbers_.line() > 0 ? fmt::format("line {}: ", numbers_.line()) : "", property.name, count));
    list.resize(static_cast<std::size_t>(count));
    for (double& number : list) number = numbers_.take(property.type);
  }

  void read_lists(const Element& element) {
    std::vector<double> corners, texture;
    for (const Property& property : element.property) {
      if (!property.count) {
        numbers_.take(property.type);
        continue;
      }
      take_list(property, list_);
      if (property.name == "vertex_indices" || property.name == "vertex_index") corners = list_;
      if (property.name == "texcoord") texture = list_;
    }
    if (element.name == "face") add_face(corners, texture);
    if (element.name == "tristrips") add_strips(corners);
  }

  static long long whole(double corner) { return std::abs(corner) < 1e15 ? static_cast<long long>(corner) : -1; }
  int material() const { return header_.texture.empty() ? -1 : 0; }

  void add_face(const std::vector<double>& corners, const std::vector<double>& texture) {
    if (corners.size() < 3) return builder_.ignore("faces with fewer than three corners");
    Polygon polygon;
    polygon.material = material();
    polygon.line = numbers_.line();
    for (const double corner : corners) polygon.corner.push_back(whole(corner));
    if (texture.size() == 2 * corners.size())
      for (std::size_t k = 0; k < corners.size(); ++k)
        polygon.texture.push_back(
            texture_number({static_cast<float>(texture[2 * k]), static_cast<float>(texture[2 * k + 1])}));
    add(std::move(polygon));
  }

  int texture_number(const std::pair<float, float>& uv) {
    const auto [found, is_new] = texture_number_.try_emplace(uv, builder_.textures());
    if (is_new) builder_.add_texture({uv.first, uv.second});
    return found->second;
  }

  // Vertices may come after faces, which then wait.
  void add(Polygon polygon) {
    if (has_vertices_)
      builder_.add_polygon(polygon);
    else
      waiting_.push_back(std::move(polygon));
  }

  // Triangles of strips; -1 begins a new one. Every other triangle of a strip is turned over.
  void add_strips(const std::vector<double>& corners) {
    std::vector<long long> strip;
    for (const double number : corners) {
      strip.push_back(whole(number));
      if (strip.back() == -1) strip.clear();
      const std::size_t n = strip.size();
      if (n < 3) continue;
      const bool turned = n % 2 == 0;
      const long long a = strip[n - 3], b = strip[n - 2], c = strip[n - 1];
      if (a == b || b == c || c == a) continue;  // how strips turn a corner
      add({{a, turned ? c : b, turned ? b : c}, {}, material(), numbers_.line()});
    }
  }

  const PlyHeader& header_;
  Numbers& numbers_;
  const ImportLimits& limits_;
  std::size_t bytes_;
  SoupBuilder builder_;
  bool has_range_grid_ = false, has_vertices_ = false, has_uv_ = false, has_colour_ = false;
  std::vector<double> list_;
  std::vector<std::pair<const std::string*, float>> weights_;
  std::vector<Polygon> waiting_;
  std::map<std::pair<float, float>, int> texture_number_;
};

// Texts in other encodings are rewritten; what is binary stays.
bool is_binary(const std::string& bytes) {
  return std::string_view(bytes).substr(0, 1 << 16).find("format binary") != std::string_view::npos;
}

}  // namespace

PolygonSoup read_ply(const std::filesystem::path& file, const ImportLimits& limits) {
  std::string bytes = read_bytes(file);
  if (!is_binary(bytes)) bytes = plain_text(std::move(bytes));
  const PlyHeader header = HeaderReader(bytes).header();
  const std::string_view data = std::string_view(bytes).substr(header.length);
  if (header.format == PlyHeader::Format::ascii) {
    const auto lines = std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(header.length), '\n');
    TextNumbers numbers(data, static_cast<int>(lines) + 1);
    return Body(header, numbers, limits, data.size()).soup();
  }
  BinaryNumbers numbers(data, header.format == PlyHeader::Format::little ? std::endian::little : std::endian::big);
  return Body(header, numbers, limits, data.size()).soup();
}

}  // namespace billow::sim
