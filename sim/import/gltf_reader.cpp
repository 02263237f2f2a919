// From glTF's nodes to raw vertices and faces.
#include "sim/import/gltf_reader.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "sim/import/gltf_document.h"
#include "sim/import/soup_builder.h"

namespace billow::sim {
namespace {

using nlohmann::json;

constexpr std::size_t most_nodes = 100000;

// Extensions that change nothing of a mesh's shape, or that are read.
bool is_known(const std::string& extension) {
  constexpr std::string_view harmless[] = {"KHR_mesh_quantization", "KHR_texture_",   "EXT_texture_",
                                           "MSFT_texture_",         "KHR_materials_", "KHR_lights_",
                                           "KHR_technique_webgl",   "KHR_xmp"};
  return std::any_of(std::begin(harmless), std::end(harmless),
                     [&](std::string_view known) { return extension.starts_with(known); });
}

void check_extensions(const json& root, SoupBuilder& builder) {
  for (const json& item : gltf_part(root, "extensionsRequired"))
    if (const std::string name = item.is_string() ? item.get<std::string>() : item.dump(); !is_known(name))
      throw InputError(fmt::format("it needs the extension {}, which is not supported; export it without", name));
  for (const json& item : gltf_part(root, "extensionsUsed"))
    if (const std::string name = item.is_string() ? item.get<std::string>() : item.dump();
        name != "KHR_mesh_quantization" && name != "KHR_texture_transform")
      builder.ignore(fmt::format("extension {}", name));
  if (gltf_part(root, "animations").size() > 0) builder.ignore("animations");
}

Eigen::Affine3d local_transform(const json& node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (const std::vector<double> matrix = gltf_numbers(node, "matrix", 16); !matrix.empty()) {
    transform.matrix() = Eigen::Matrix4d(matrix.data());
    return transform;
  }
  if (const std::vector<double> move = gltf_numbers(node, "translation", 3); !move.empty())
    transform.translate(Eigen::Vector3d(move.data()));
  if (const std::vector<double> turn = gltf_numbers(node, "rotation", 4); !turn.empty())
    transform.rotate(Eigen::Quaterniond(turn[3], turn[0], turn[1], turn[2]).normalized());
  if (const std::vector<double> scale = gltf_numbers(node, "scale", 3); !scale.empty())
    transform.scale(Eigen::Vector3d(scale.data()));
  return transform;
}

// The nodes of the scene, depth first, each with where its parents put it and how they are called.
struct PlacedNode {
  long long index;
  const json* node;
  Eigen::Affine3d to_world;
  std::vector<std::string> names;
};

std::vector<long long> scene_roots(const GltfDocument& document) {
  const json& root = document.root();
  std::vector<long long> roots;
  if (const json& scenes = gltf_part(root, "scenes"); scenes.size() > 0) {
    for (const json& node : gltf_part(document.entry("scenes", gltf_integer(root, "scene", 0)), "nodes"))
      roots.push_back(node.is_number_integer() ? node.get<long long>() : -1);
    return roots;
  }
  // Without a scene: all that are nobody's children.
  std::set<long long> children;
  const json& nodes = gltf_part(root, "nodes");
  for (const json& node : nodes)
    for (const json& child : gltf_part(node, "children"))
      if (child.is_number_integer()) children.insert(child.get<long long>());
  for (long long k = 0; k < static_cast<long long>(nodes.size()); ++k)
    if (!children.contains(k)) roots.push_back(k);
  return roots;
}

std::vector<PlacedNode> placed_nodes(const GltfDocument& document) {
  std::vector<PlacedNode> placed, open;
  const auto add = [&](const json& index, const Eigen::Affine3d& to_world, const std::vector<std::string>& names) {
    const json& node = document.entry("nodes", index);
    PlacedNode next{index.get<long long>(), &node, to_world * local_transform(node), names};
    if (const std::string name = gltf_text(node, "name"); !name.empty()) next.names.push_back(name);
    open.push_back(std::move(next));
  };
  std::vector<long long> roots = scene_roots(document);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) add(*root, Eigen::Affine3d::Identity(), {});
  while (!open.empty()) {
    PlacedNode next = std::move(open.back());
    open.pop_back();
    if (placed.size() > most_nodes)
      throw InputError("its nodes form a loop, or there are more than 100000; it is broken, export it again");
    const json& children = gltf_part(*next.node, "children");
    for (std::size_t k = children.size(); k-- > 0;) add(children[k], next.to_world, next.names);
    placed.push_back(std::move(next));
  }
  return placed;
}

// 3 (i - 2), ... corners of triangles in a list, a strip or a fan of `count` corners.
std::vector<std::array<long long, 3>> triangles(long long mode, long long count) {
  std::vector<std::array<long long, 3>> list;
  if (mode == 4)
    for (long long k = 0; k + 2 < count; k += 3) list.push_back({k, k + 1, k + 2});
  if (mode == 5)
    for (long long k = 0; k + 2 < count; ++k) list.push_back({k, k + 1 + k % 2, k + 2 - k % 2});
  if (mode == 6)
    for (long long k = 1; k + 1 < count; ++k) list.push_back({k, k + 1, 0});
  return list;
}

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& file, const ImportLimits& limits)
      : document_(file, limits.max_file_bytes), limits_(limits), builder_(limits) {}

  PolygonSoup soup() {
    check_extensions(document_.root(), builder_);
    for (const json& material : gltf_part(document_.root(), "materials")) add_material(material);
    nodes_ = placed_nodes(document_);
    for (const PlacedNode& node : nodes_) add_node(node);
    if (builder_.vertices() > 0 && builder_.faces() == 0 && gltf_part(document_.root(), "meshes").size() > 0)
      throw InputError("its meshes are points or lines; export it with its faces");
    PolygonSoup soup = builder_.soup();
    soup.linear_colour = true;
    return soup;
  }

 private:
  // ---- materials ----

  void add_material(const json& given) {
    Material material;
    material.name = gltf_text(given, "name");
    const json& surface = gltf_part(given, "pbrMetallicRoughness");
    if (const std::vector<double> factor = gltf_numbers(surface, "baseColorFactor", 4); !factor.empty())
      material.colour = Eigen::Vector4d(factor.data()).cast<float>().cwiseMax(0.0f).cwiseMin(1.0f);
    const std::string alpha = gltf_text(given, "alphaMode");
    material.alpha = alpha == "MASK" ? AlphaMode::cut_out : alpha == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
    material.cutoff = static_cast<float>(gltf_number(given, "alphaCutoff", 0.5));
    texture_info_.push_back(gltf_part(surface, "baseColorTexture"));
    if (!texture_info_.back().is_null()) add_texture(texture_info_.back(), material);
    for (const char* map : {"normalTexture", "occlusionTexture", "emissiveTexture"})
      if (given.contains(map)) builder_.ignore(fmt::format("maps {} of materials", map));
    if (surface.contains("metallicRoughnessTexture")) builder_.ignore("maps metallicRoughnessTexture of materials");
    builder_.add_material(std::move(material));
  }

  void add_texture(const json& info, Material& material) {
    const json& texture = document_.entry("textures", info.value("index", json()));
    const auto source = texture.find("source");
    if (source == texture.end()) return builder_.ignore("textures in formats other than PNG and JPEG");
    const json& image = document_.entry("images", *source);
    const std::string uri = gltf_text(image, "uri");
    if (!uri.empty() && !uri.starts_with("data:"))
      material.texture = from_percent(uri);
    else if (!uri.empty())
      material.texture_bytes = document_.resource(uri);
    else
      material.texture_bytes = document_.view(image.value("bufferView", json()));
  }

  // ---- geometry ----

  void add_node(const PlacedNode& node) {
    const auto index = node.node->find("mesh");
    if (index == node.node->end()) return;
    if (gltf_part(*node.node, "extensions").contains("EXT_mesh_gpu_instancing"))
      builder_.ignore("instances of EXT_mesh_gpu_instancing (one is read)");
    const json& mesh = document_.entry("meshes", *index);
    for (const json& primitive : gltf_part(mesh, "primitives")) add_primitive(primitive, mesh, node);
  }

  void add_primitive(const json& primitive, const json& mesh, const PlacedNode& node) {
    const long long mode = gltf_integer(primitive, "mode", 4);
    if (mode < 4) return builder_.ignore(mode == 0 ? "points" : "lines");
    const json& attributes = gltf_part(primitive, "attributes");
    if (!attributes.contains("POSITION")) return builder_.ignore("primitives without positions");
    const int first = builder_.vertices();
    const bool mirrored = add_vertices(primitive, mesh, node);
    add_attributes(attributes, static_cast<int>(material_of(primitive)), first);
    add_faces(primitive, mode, first, mirrored);
    std::vector<std::string> names = node.names;
    names.push_back(gltf_text(mesh, "name"));
    if (const long long material = material_of(primitive); material >= 0)
      names.push_back(gltf_text(document_.entry("materials", material), "name"));
    for (const std::string& name : names)
      for (int v = first; v < builder_.vertices() && !name.empty(); ++v) builder_.add_member(name, v);
  }

  long long material_of(const json& primitive) const {
    const long long material = gltf_integer(primitive, "material", -1);
    if (material >= 0) document_.entry("materials", material);
    return material;
  }

  Eigen::MatrixXd read(const json& accessor, Eigen::Index columns, Eigen::Index rows, const char* what) const {
    Eigen::MatrixXd numbers = document_.numbers(accessor, limits_.max_vertices);
    if (numbers.cols() < columns || (rows >= 0 && numbers.rows() != rows))
      throw InputError(fmt::format(
          "its {} has {} rows of {} numbers, which does not fit its positions; it is broken, export it again", what,
          numbers.rows(), numbers.cols()));
    return numbers;
  }

  // Returns whether they are mirrored on their way into the world.
  bool add_vertices(const json& primitive, const json& mesh, const PlacedNode& node) {
    const json& attributes = gltf_part(primitive, "attributes");
    Eigen::MatrixXd place = read(attributes["POSITION"], 3, -1, "POSITION");
    add_morphs(primitive, mesh, *node.node, place);
    const bool skinned =
        node.node->contains("skin") && attributes.contains("JOINTS_0") && attributes.contains("WEIGHTS_0");
    if (skinned)
      add_skinned(attributes, *node.node, place);
    else
      for (Eigen::Index v = 0; v < place.rows(); ++v)
        builder_.add_vertex(node.to_world * Eigen::Vector3d(place.row(v).transpose()));
    return !skinned && node.to_world.linear().determinant() < 0.0;
  }

  // The morph targets at the weights that hold at rest.
  void add_morphs(const json& primitive, const json& mesh, const json& node, Eigen::MatrixXd& place) {
    const json& targets = gltf_part(primitive, "targets");
    if (targets.size() == 0) return;
    const json& weights = node.contains("weights") ? gltf_part(node, "weights") : gltf_part(mesh, "weights");
    builder_.ignore("morph targets (read at their weights at rest)");
    for (std::size_t k = 0; k < targets.size() && k < weights.size(); ++k)
      if (const double weight = weights[k].is_number() ? weights[k].get<double>() : 0.0;
          weight != 0.0 && targets[k].contains("POSITION"))
        place += weight * read(targets[k]["POSITION"], 3, place.rows(), "morph target").leftCols(place.cols());
  }

  const PlacedNode& placed(const json& index) const {
    for (const PlacedNode& node : nodes_)
      if (index.is_number_integer() && node.index == index.get<long long>()) return node;
    throw InputError("a skin has a joint that is not in the scene; it is broken, export it again");
  }

  // Where a skin puts vertices at rest; each joint's share of them is a weight of its name.
  void add_skinned(const json& attributes, const json& node, const Eigen::MatrixXd& place) {
    const json& skin = document_.entry("skins", node["skin"]);
    const json& joints = gltf_part(skin, "joints");
    Eigen::MatrixXd inverse;
    if (skin.contains("inverseBindMatrices"))
      inverse = read(skin["inverseBindMatrices"], 16, static_cast<Eigen::Index>(joints.size()), "inverseBindMatrices");
    std::vector<Eigen::Matrix4d> pose;
    std::vector<std::string> name;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const PlacedNode& joint = placed(joints[j]);
      Eigen::Matrix4d bind = Eigen::Matrix4d::Identity();
      if (inverse.rows() > 0) bind = Eigen::Matrix4d(Eigen::VectorXd(inverse.row(static_cast<Eigen::Index>(j))).data());
      pose.push_back(joint.to_world.matrix() * bind);
      name.push_back(gltf_text(*joint.node, "name"));
    }
    const Eigen::MatrixXd joint = read(attributes["JOINTS_0"], 4, place.rows(), "JOINTS_0");
    const Eigen::MatrixXd weight = read(attributes["WEIGHTS_0"], 4, place.rows(), "WEIGHTS_0");
    for (Eigen::Index v = 0; v < place.rows(); ++v)
      add_skinned_vertex(place.row(v), joint.row(v), weight.row(v), pose, name);
    builder_.ignore("skins (their joints are weights, their pose at rest is read)");
  }

  void add_skinned_vertex(const Eigen::RowVectorXd& place, const Eigen::RowVectorXd& joint,
                          const Eigen::RowVectorXd& weight, const std::vector<Eigen::Matrix4d>& pose,
                          const std::vector<std::string>& name) {
    const double sum = weight.head(4).sum();
    Eigen::Vector4d moved = Eigen::Vector4d::Zero();
    const Eigen::Vector4d rest(place(0), place(1), place(2), 1.0);
    for (int k = 0; k < 4; ++k) {
      if (weight(k) == 0.0) continue;
      const auto j = static_cast<std::size_t>(joint(k));
      if (j >= pose.size())
        throw InputError("a vertex names a joint that its skin lacks; it is broken, export it again");
      moved += weight(k) / sum * (pose[j] * rest);
    }
    const int vertex =
        builder_.add_vertex(sum > 0.0 ? Eigen::Vector3d(moved.head<3>()) : Eigen::Vector3d(rest.head<3>()));
    for (int k = 0; k < 4; ++k)
      if (weight(k) != 0.0 && !name[static_cast<std::size_t>(joint(k))].empty())
        builder_.set_weight(vertex, name[static_cast<std::size_t>(joint(k))], static_cast<float>(weight(k)));
  }

  void add_attributes(const json& attributes, int material, int first) {
    const auto rows = static_cast<Eigen::Index>(builder_.vertices() - first);
    const json info = material >= 0 ? texture_info_[static_cast<std::size_t>(material)] : json();
    const json& transform = gltf_part(gltf_part(info, "extensions"), "KHR_texture_transform");
    const long long set = gltf_integer(transform, "texCoord", gltf_integer(info, "texCoord", 0));
    if (const std::string key = fmt::format("TEXCOORD_{}", set); attributes.contains(key))
      add_uv(read(attributes[key], 2, rows, key.c_str()), transform, first);
    if (attributes.contains("COLOR_0")) {
      const Eigen::MatrixXd colour = read(attributes["COLOR_0"], 3, rows, "COLOR_0");
      for (Eigen::Index v = 0; v < rows; ++v)
        builder_.set_colour(first + static_cast<int>(v), colour.row(v).head<3>().transpose().cast<float>());
    }
    for (const auto& [key, accessor] : attributes.items()) {
      if (!key.starts_with('_')) continue;
      const Eigen::MatrixXd value = read(accessor, 1, rows, key.c_str());
      for (Eigen::Index v = 0; v < rows; ++v)
        builder_.set_weight(first + static_cast<int>(v), key.substr(1), static_cast<float>(value(v, 0)));
    }
  }

  // glTF counts v from the top.
  void add_uv(const Eigen::MatrixXd& uv, const json& transform, int first) {
    Eigen::Vector2d offset = Eigen::Vector2d::Zero(), scale = Eigen::Vector2d::Ones();
    if (const std::vector<double> given = gltf_numbers(transform, "offset", 2); !given.empty())
      offset = {given[0], given[1]};
    if (const std::vector<double> given = gltf_numbers(transform, "scale", 2); !given.empty())
      scale = {given[0], given[1]};
    const double angle = gltf_number(transform, "rotation", 0.0);
    Eigen::Matrix2d turn;
    turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    for (Eigen::Index v = 0; v < uv.rows(); ++v) {
      Eigen::Vector2d at = uv.row(v).head<2>().transpose();
      if (!transform.is_null()) at = turn * scale.cwiseProduct(at) + offset;
      builder_.set_uv(first + static_cast<int>(v),
                      Eigen::Vector2f(static_cast<float>(at.x()), 1.0f - static_cast<float>(at.y())));
    }
  }

  void add_faces(const json& primitive, long long mode, int first, bool mirrored) {
    const auto vertices = static_cast<long long>(builder_.vertices() - first);
    Eigen::MatrixXd index;
    const bool indexed = primitive.contains("indices");
    if (indexed) index = document_.numbers(primitive["indices"], 3ll * limits_.max_faces + 2);
    const long long count = indexed ? index.rows() : vertices;
    if (mode == 4 && count % 3 != 0)
      throw InputError(fmt::format(
          "it has {} corners of triangles, which is no multiple of 3; it is broken, export it again", count));
    for (const std::array<long long, 3>& triangle : triangles(mode, count)) {
      SoupBuilder::Polygon polygon;
      polygon.material = static_cast<int>(material_of(primitive));
      for (const long long corner : triangle) {
        const double vertex = indexed ? index(corner, 0) : static_cast<double>(corner);
        if (!(vertex < static_cast<double>(vertices)))
          throw InputError(fmt::format("a face uses vertex {} (counted from 0), but there are {}; export it again",
                                       vertex, vertices));
        polygon.corner.push_back(first + static_cast<long long>(vertex));
      }
      const long long a = polygon.corner[0], b = polygon.corner[1], c = polygon.corner[2];
      if (mode != 4 && (a == b || b == c || c == a)) continue;        // how strips turn a corner
      if (mirrored) std::swap(polygon.corner[1], polygon.corner[2]);  // a mirror turns counter-clockwise into clockwise
      builder_.add_polygon(polygon);
    }
  }

  GltfDocument document_;
  const ImportLimits& limits_;
  SoupBuilder builder_;
  std::vector<json> texture_info_;  // per material
  std::vector<PlacedNode> nodes_;
};

}  // namespace

PolygonSoup read_gltf(const std::filesystem::path& file, const ImportLimits& limits) {
  try {
    return GltfReader(file, limits).soup();
  } catch (const json::exception& error) {  // a value of another type than the format has there
    throw InputError(
        fmt::format("its JSON is not what glTF has there ({}); it is broken, export it again", error.what()));
  }
}

}  // namespace billow::sim
