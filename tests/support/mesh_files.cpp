// Grids, and writers for the six mesh formats, as short as the formats allow.
#include "tests/support/mesh_files.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace billow::test {
namespace {

using nlohmann::json;
using sim::Face;
using sim::Mesh;

std::string corners(const Face& face, int base) {
  std::string text;
  for (int c = 0; c < sim::corner_count(face); ++c) text += fmt::format(" {}", face[c] + base);
  return text;
}

std::string positions(const Mesh& mesh, const char* prefix) {
  std::string text;
  for (int v = 0; v < mesh.vertices(); ++v)
    text += fmt::format("{}{} {} {}\n", prefix, mesh.position(v, 0), mesh.position(v, 1), mesh.position(v, 2));
  return text;
}

std::string obj(const Mesh& mesh) {
  std::string text = positions(mesh, "v ");
  for (const Face& face : mesh.face) text += "f" + corners(face, 1) + "\n";
  return text;
}

std::string off(const Mesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices(), mesh.face.size()) + positions(mesh, "");
  for (const Face& face : mesh.face) text += fmt::format("{}{}\n", sim::corner_count(face), corners(face, 0));
  return text;
}

std::string ply(const Mesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices(), mesh.face.size());
  text += positions(mesh, "");
  for (const Face& face : mesh.face) text += fmt::format("{}{}\n", sim::corner_count(face), corners(face, 0));
  return text;
}

std::string stl(const Mesh& mesh) {
  std::string text = "solid grid\n";
  for (const Face& face : mesh.face) {
    text += "facet normal 0 1 0\nouter loop\n";
    for (int c = 0; c < 3; ++c) {
      const auto p = mesh.position.row(face[c]);
      text += fmt::format("vertex {} {} {}\n", p.x(), p.y(), p.z());
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid grid\n";
}

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Positions as floats, then indices as 32-bit integers.
std::string gltf_buffer(const Mesh& mesh) {
  std::string bytes;
  for (int v = 0; v < mesh.vertices(); ++v)
    for (int axis = 0; axis < 3; ++axis) append(bytes, static_cast<float>(mesh.position(v, axis)));
  for (const Face& face : mesh.face)
    for (int c = 0; c < 3; ++c) append(bytes, static_cast<std::uint32_t>(face[c]));
  return bytes;
}

json gltf_document(const Mesh& mesh, std::size_t buffer_bytes) {
  const std::size_t position_bytes = 12 * static_cast<std::size_t>(mesh.vertices());
  const auto bound = [](const Eigen::RowVector3d& p) { return json{p.x(), p.y(), p.z()}; };
  return {{"asset", {{"version", "2.0"}}},
          {"scene", 0},
          {"scenes", {{{"nodes", {0}}}}},
          {"nodes", {{{"name", "Cloth"}, {"mesh", 0}}}},
          {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
          {"buffers", {{{"byteLength", buffer_bytes}}}},
          {"bufferViews",
           {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", position_bytes}},
            {{"buffer", 0}, {"byteOffset", position_bytes}, {"byteLength", buffer_bytes - position_bytes}}}},
          {"accessors",
           {{{"bufferView", 0},
             {"componentType", 5126},
             {"count", mesh.vertices()},
             {"type", "VEC3"},
             {"min", bound(mesh.position.colwise().minCoeff())},
             {"max", bound(mesh.position.colwise().maxCoeff())}},
            {{"bufferView", 1}, {"componentType", 5125}, {"count", 3 * mesh.face.size()}, {"type", "SCALAR"}}}}};
}

std::string base64(std::string_view bytes) {
  constexpr char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j) text += k + j <= bytes.size() ? digit[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

std::string gltf(const Mesh& mesh) {
  const std::string buffer = gltf_buffer(mesh);
  json document = gltf_document(mesh, buffer.size());
  document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(buffer);
  return document.dump();
}

std::string glb(const Mesh& mesh) {
  const std::string buffer = gltf_buffer(mesh);
  std::string document = gltf_document(mesh, buffer.size()).dump();
  document.resize((document.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(12 + 8 + document.size() + 8 + buffer.size()));
  append(bytes, static_cast<std::uint32_t>(document.size()));
  bytes += "JSON" + document;
  append(bytes, static_cast<std::uint32_t>(buffer.size()));
  bytes += std::string("BIN\0", 4) + buffer;
  return bytes;
}

}  // namespace

Mesh quad_grid(int width, int height) {
  Mesh mesh;
  mesh.position.resize(width * height, 3);
  const auto uv = [&](int x, int z) {
    return Eigen::Vector2f(static_cast<float>(x) / static_cast<float>(width - 1),
                           1.0f - static_cast<float>(z) / static_cast<float>(height - 1));
  };
  for (int z = 0; z < height; ++z)
    for (int x = 0; x < width; ++x) mesh.position.row(x + width * z) << x, 0.0, z;
  for (int z = 0; z + 1 < height; ++z)
    for (int x = 0; x + 1 < width; ++x) {
      const int v = x + width * z;
      mesh.face.push_back({v, v + width, v + width + 1, v + 1});
      mesh.uv.push_back({uv(x, z), uv(x, z + 1), uv(x + 1, z + 1), uv(x + 1, z)});
    }
  return mesh;
}

Mesh triangulated(const Mesh& mesh) {
  Mesh result = mesh;
  result.face.clear();
  result.uv.clear();
  for (std::size_t f = 0; f < mesh.face.size(); ++f)
    for (int k = 2; k < sim::corner_count(mesh.face[f]); ++k) {
      result.face.push_back({mesh.face[f][0], mesh.face[f][k - 1], mesh.face[f][k], -1});
      if (mesh.uv.empty()) continue;
      result.uv.push_back({mesh.uv[f][0], mesh.uv[f][k - 1], mesh.uv[f][k], Eigen::Vector2f::Zero()});
    }
  return result;
}

Mesh bare_mesh(const std::vector<Eigen::Vector3d>& positions, const std::vector<Face>& faces) {
  Mesh mesh;
  mesh.position.resize(static_cast<Eigen::Index>(positions.size()), 3);
  for (std::size_t v = 0; v < positions.size(); ++v) mesh.position.row(static_cast<Eigen::Index>(v)) = positions[v];
  mesh.face = faces;
  return mesh;
}

sim::PolygonSoup soup_of(const Mesh& mesh) {
  sim::PolygonSoup soup;
  const Eigen::Index most = 4 * static_cast<Eigen::Index>(mesh.face.size());
  soup.position.resize(most, 3);
  soup.uv.resize(mesh.uv.empty() ? 0 : most, 2);
  int raw = 0;
  for (std::size_t f = 0; f < mesh.face.size(); ++f) {
    Face face{-1, -1, -1, -1};
    for (int c = 0; c < sim::corner_count(mesh.face[f]); ++c) {
      soup.position.row(raw) = mesh.position.row(mesh.face[f][c]);
      if (!mesh.uv.empty()) soup.uv.row(raw) = mesh.uv[f][c];
      face[c] = raw++;
    }
    soup.face.push_back(face);
  }
  soup.position.conservativeResize(raw, Eigen::NoChange);
  if (!mesh.uv.empty()) soup.uv.conservativeResize(raw, Eigen::NoChange);
  return soup;
}

std::string mesh_file(std::string_view extension, const Mesh& mesh) {
  if (extension == "obj") return obj(mesh);
  if (extension == "off") return off(mesh);
  if (extension == "ply") return ply(mesh);
  if (extension == "stl") return stl(mesh);
  if (extension == "gltf") return gltf(mesh);
  if (extension == "glb") return glb(mesh);
  throw std::invalid_argument(std::string(extension));
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "billow-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::string& name, std::string_view bytes) const {
  const std::filesystem::path file = path_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

}  // namespace billow::test
