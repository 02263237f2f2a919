// Surfaces -> GLB: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include "cli/cache/glb_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cli/text/json_text.h"
#include "render/frame/body_mesh.h"
#include "render/frame/normals.h"
#include "render/image/png.h"

namespace billow::cli {

namespace {

static_assert(std::endian::native == std::endian::little);  // as glTF wants its numbers

using Json = nlohmann::ordered_json;
using Rows3 = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Rows2 = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;

// glTF's numbers for what an accessor holds and what a view is for.
constexpr int unsigned_short = 5123, unsigned_int = 5125, float_number = 5126;
constexpr int vertex_data = 34962, index_data = 34963;

struct Shape {
  Rows3 position, normal;  // (c x 3) of a part's corners
};

Shape shape_of(const sim::Surface& surface, const Eigen::MatrixX3f& position) {
  const Eigen::MatrixX3f normal = render::point_normals(surface, position);
  Shape shape{Rows3(surface.point.size(), 3), Rows3(surface.point.size(), 3)};
  for (Eigen::Index c = 0; c < surface.point.size(); ++c) {
    shape.position.row(c) = position.row(surface.point(c));
    shape.normal.row(c) = normal.row(surface.point(c));
    if (shape.normal.row(c).isZero(0.0f)) shape.normal.row(c) << 0.0f, 1.0f, 0.0f;  // glTF wants a unit vector
  }
  return shape;
}

void append_number(std::string& bytes, std::uint32_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void pad(std::string& bytes, char filler) { bytes.resize((bytes.size() + 3) / 4 * 4, filler); }

/// Gathers the document and its binary chunk.
class Document {
 public:
  Document(const std::vector<GlbKey>& keys, const Eigen::Vector3d& origin) : keys_(keys), origin_(origin) {
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "billow"}}}, {"scene", 0}};
    json_["scenes"] = Json::array({{{"nodes", Json::array()}}});
  }

  void add(const GlbPart& part, std::size_t index);
  std::string bytes();

 private:
  int view(const void* data, std::size_t size, int target = 0);
  int accessor(const void* data, std::size_t size, Json about, int target = 0);
  template <class Rows>
  int attribute(const Rows& rows, bool bounded);
  int indices(const sim::Surface& surface, const render::TriangleRange& range);
  int material(const std::string& name, const render::Finish& finish);
  Json primitives(const GlbPart& part, const Json& attributes, const Json& moves);
  int texture(const render::Image& image);
  Json targets(const GlbPart& part, std::size_t index, const Shape& base);
  void animate(int node);
  int add_to(const char* list, Json entry) {
    json_[list].push_back(std::move(entry));
    return static_cast<int>(json_[list].size()) - 1;
  }

  const std::vector<GlbKey>& keys_;
  Eigen::Vector3d origin_;
  Json json_;
  std::string binary_;
  std::vector<const render::Image*> images_;
  int key_times_ = -1, key_weights_ = -1;  // accessors, once something moves
};

int Document::view(const void* data, std::size_t size, int target) {
  pad(binary_, '\0');
  Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
  if (target != 0) view["target"] = target;
  binary_.append(static_cast<const char*>(data), size);
  return add_to("bufferViews", std::move(view));
}

int Document::accessor(const void* data, std::size_t size, Json about, int target) {
  about["bufferView"] = view(data, size, target);
  return add_to("accessors", std::move(about));
}

template <class Rows>
int Document::attribute(const Rows& rows, bool bounded) {
  Json about = {{"componentType", float_number},
                {"count", rows.rows()},
                {"type", Rows::ColsAtCompileTime == 3 ? "VEC3" : "VEC2"}};
  if (bounded)
    for (int axis = 0; axis < rows.cols(); ++axis) {
      about["min"].push_back(rows.col(axis).minCoeff());
      about["max"].push_back(rows.col(axis).maxCoeff());
    }
  return accessor(rows.data(), sizeof(float) * static_cast<std::size_t>(rows.size()), std::move(about), vertex_data);
}

// Corners of the triangles of one material.
int Document::indices(const sim::Surface& surface, const render::TriangleRange& range) {
  const auto write = [&]<class Index>(Index, int type) {
    const Eigen::Matrix<Index, Eigen::Dynamic, 3, Eigen::RowMajor> list =
        surface.triangle.middleRows(range.first, range.count).cast<Index>();
    return accessor(list.data(), sizeof(Index) * static_cast<std::size_t>(list.size()),
                    {{"componentType", type}, {"count", list.size()}, {"type", "SCALAR"}}, index_data);
  };
  // The largest number of a type means "restart" and is no index.
  return surface.point.size() <= std::numeric_limits<std::uint16_t>::max() ? write(std::uint16_t(), unsigned_short)
                                                                           : write(std::uint32_t(), unsigned_int);
}

// Bodies that wear the same picture share it.
int Document::texture(const render::Image& image) {
  const auto same = std::find_if(images_.begin(), images_.end(), [&](const render::Image* known) {
    return known->width == image.width && known->channels == image.channels && known->pixels == image.pixels;
  });
  const int index = static_cast<int>(same - images_.begin());
  if (same != images_.end()) return index;
  images_.push_back(&image);
  const std::string png = render::encode_png(image);
  add_to("images", {{"mimeType", "image/png"}, {"bufferView", view(png.data(), png.size())}});
  if (index == 0) add_to("samplers", {{"wrapS", 10497}, {"wrapT", 10497}, {"minFilter", 9987}, {"magFilter", 9729}});
  return add_to("textures", {{"sampler", 0}, {"source", index}});
}

int Document::material(const std::string& name, const render::Finish& finish) {
  const Eigen::Vector3f& colour = finish.colour;
  Json surface = {{"metallicFactor", 0.0}, {"roughnessFactor", 0.8}};
  if (finish.texture.pixels.empty() || colour != Eigen::Vector3f::Ones() || finish.opacity < 1.0f)
    surface["baseColorFactor"] = Json::array({colour.x(), colour.y(), colour.z(), finish.opacity});
  if (!finish.texture.pixels.empty()) surface["baseColorTexture"] = {{"index", texture(finish.texture)}};
  Json entry = {{"name", name}, {"pbrMetallicRoughness", std::move(surface)}, {"doubleSided", true}};
  if (finish.alpha == AlphaMode::cut_out) entry["alphaMode"] = "MASK", entry["alphaCutoff"] = finish.cutoff;
  if (finish.alpha == AlphaMode::blend) entry["alphaMode"] = "BLEND";
  return add_to("materials", std::move(entry));
}

// Displacements from the first key. Empty where the part never moves.
Json Document::targets(const GlbPart& part, std::size_t index, const Shape& base) {
  const auto still = [&](const GlbKey& key) { return key.positions[index] == keys_.front().positions[index]; };
  Json list = Json::array();
  if (std::all_of(keys_.begin(), keys_.end(), still)) return list;
  for (std::size_t k = 1; k < keys_.size(); ++k) {
    const Shape shape = shape_of(part.drawn.surface, keys_[k].positions[index]);
    const Rows3 moved = shape.position - base.position, turned = shape.normal - base.normal;
    list.push_back({{"POSITION", attribute(moved, true)}, {"NORMAL", attribute(turned, false)}});
  }
  return list;
}

// One sampler's numbers serve every node. Its output holds all weights of the first key, then all of the second, ...
void Document::animate(int node) {
  const std::size_t targets = keys_.size() - 1;
  if (key_times_ < 0) {
    std::vector<float> times, weights(keys_.size() * targets, 0.0f);
    for (const GlbKey& key : keys_) times.push_back(static_cast<float>(key.time));
    for (std::size_t k = 1; k < keys_.size(); ++k) weights[k * targets + k - 1] = 1.0f;
    key_times_ = accessor(times.data(), sizeof(float) * times.size(),
                          {{"componentType", float_number},
                           {"count", times.size()},
                           {"type", "SCALAR"},
                           {"min", Json::array({times.front()})},
                           {"max", Json::array({times.back()})}});
    key_weights_ = accessor(weights.data(), sizeof(float) * weights.size(),
                            {{"componentType", float_number}, {"count", weights.size()}, {"type", "SCALAR"}});
    json_["animations"] = Json::array({{{"name", "run"}, {"channels", Json::array()}, {"samplers", Json::array()}}});
    json_["animations"][0]["samplers"].push_back(
        {{"input", key_times_}, {"output", key_weights_}, {"interpolation", "LINEAR"}});
  }
  json_["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}});
}

// One primitive for each finish, all over the same vertices.
Json Document::primitives(const GlbPart& part, const Json& attributes, const Json& moves) {
  Json list = Json::array();
  for (std::size_t m = 0; m < part.drawn.finish.size(); ++m) {
    const render::TriangleRange range = render::triangles_of(part.drawn.surface, static_cast<int>(m));
    if (range.count == 0) continue;
    Json primitive = {{"attributes", attributes}, {"indices", indices(part.drawn.surface, range)}};
    const bool several = part.drawn.finish.size() > 1;
    primitive["material"] =
        material(several ? fmt::format("{}_{}", part.name, m + 1) : part.name, part.drawn.finish[m]);
    if (!moves.empty()) primitive["targets"] = moves;
    list.push_back(std::move(primitive));
  }
  return list;
}

void Document::add(const GlbPart& part, std::size_t index) {
  const sim::Surface& surface = part.drawn.surface;
  const Shape base = shape_of(surface, keys_.front().positions[index]);
  Rows2 uv = surface.uv;
  uv.col(1) = 1.0f - uv.col(1).array();  // glTF's v is down
  Json attributes = {{"POSITION", attribute(base.position, true)},
                     {"NORMAL", attribute(base.normal, false)},
                     {"TEXCOORD_0", attribute(uv, false)}};
  if (surface.colour.rows() > 0) attributes["COLOR_0"] = attribute(Rows3(surface.colour), false);
  Json mesh = {{"name", part.name}, {"extras", {{"role", part.role}}}};
  const Json moves = targets(part, index, base);
  for (std::size_t k = 1; k < keys_.size() && !moves.empty(); ++k)
    mesh["extras"]["targetNames"].push_back(fmt::format("{:.4f} s", keys_[k].time));
  mesh["primitives"] = primitives(part, attributes, moves);
  Json node = {{"name", part.name}, {"mesh", add_to("meshes", std::move(mesh))}};
  if (!origin_.isZero(0.0)) node["translation"] = {origin_.x(), origin_.y(), origin_.z()};
  const int number = add_to("nodes", std::move(node));
  json_["scenes"][0]["nodes"].push_back(number);
  if (!moves.empty()) animate(number);
}

std::string Document::bytes() {
  pad(binary_, '\0');
  json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
  std::string text = json_text(json_);
  pad(text, ' ');
  const std::size_t size = 12 + 8 + text.size() + 8 + binary_.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("the run's geometry does not fit into one GLB file; take fewer particles");
  std::string file = "glTF";
  append_number(file, 2);  // version
  append_number(file, static_cast<std::uint32_t>(size));
  append_number(file, static_cast<std::uint32_t>(text.size()));
  file += "JSON" + text;
  append_number(file, static_cast<std::uint32_t>(binary_.size()));
  file += std::string("BIN\0", 4);
  return file += binary_;
}

}  // namespace

std::string glb_file(const std::vector<GlbPart>& parts, const std::vector<GlbKey>& keys,
                     const Eigen::Vector3d& origin) {
  Document document(keys, origin);
  for (std::size_t p = 0; p < parts.size(); ++p) document.add(parts[p], p);
  return document.bytes();
}

}  // namespace billow::cli
