// Lists that become a soup.
#include "sim/import/soup_builder.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "sim/mesh/polygon.h"

namespace billow::sim {
namespace {

template <typename Matrix, typename Row>
Matrix rows_of(const std::vector<Row>& list) {
  Matrix matrix(static_cast<Eigen::Index>(list.size()), Matrix::ColsAtCompileTime);
  for (std::size_t r = 0; r < list.size(); ++r) matrix.row(static_cast<Eigen::Index>(r)) = list[r].transpose();
  return matrix;
}

}  // namespace

int SoupBuilder::add_vertex(const Eigen::Vector3d& position) {
  if (vertices() >= limits_.max_vertices)
    throw InputError(fmt::format("it has more than {} vertices; use a coarser mesh", limits_.max_vertices));
  position_.push_back(position);
  return vertices() - 1;
}

void SoupBuilder::set_uv(int vertex, const Eigen::Vector2f& uv) {
  uv_.resize(position_.size(), Eigen::Vector2f::Zero());
  uv_[static_cast<std::size_t>(vertex)] = uv;
}

void SoupBuilder::set_colour(int vertex, const Eigen::Vector3f& colour) {
  colour_.resize(position_.size(), Eigen::Vector3f::Ones());
  colour_[static_cast<std::size_t>(vertex)] = colour.cwiseMax(0.0f).cwiseMin(1.0f);
}

void SoupBuilder::set_weight(int vertex, const std::string& name, float weight) {
  std::vector<float>& list = weight_[name];
  list.resize(position_.size(), 0.0f);
  list[static_cast<std::size_t>(vertex)] = weight;
}

int SoupBuilder::add_texture(const Eigen::Vector2f& uv) {
  texture_.push_back(uv);
  return textures() - 1;
}

void SoupBuilder::add_polygon(const Polygon& polygon) {
  const std::size_t corners = polygon.corner.size();
  Eigen::MatrixX3d place(static_cast<Eigen::Index>(corners), 3);
  for (std::size_t k = 0; k < corners; ++k) {
    const long long c = polygon.corner[k];
    if (c < 0 || c >= vertices())
      throw InputError(fmt::format("{}a face uses vertex {} (counted from 0), but there are {}; export it again",
                                   polygon.line > 0 ? fmt::format("line {}: ", polygon.line) : "", c, vertices()));
    place.row(static_cast<Eigen::Index>(k)) = position_[static_cast<std::size_t>(c)].transpose();
  }
  for (const Face& cut : polygon_faces(place)) {
    Face face = cut, texture{-1, -1, -1, -1};
    for (int c = 0; c < corner_count(cut); ++c) {
      const auto k = static_cast<std::size_t>(cut[c]);
      face[c] = static_cast<int>(polygon.corner[k]);
      if (!polygon.texture.empty()) texture[c] = static_cast<int>(polygon.texture[k]);
    }
    face_.push_back(face);
    texture_corner_.push_back(texture);
    face_material_.push_back(polygon.material);
  }
  if (faces() > limits_.max_faces)
    throw InputError(fmt::format("it has more than {} faces; use a coarser mesh", limits_.max_faces));
}

int SoupBuilder::add_material(Material material) {
  material_.push_back(std::move(material));
  return static_cast<int>(material_.size()) - 1;
}

void SoupBuilder::ignore(const std::string& what) {
  if (std::find(ignored_.begin(), ignored_.end(), what) == ignored_.end()) ignored_.push_back(what);
}

namespace {

// The copies of vertices that texture coordinates at corners make: of each vertex one for every coordinate it has, in
// the order of the faces; one without where it has none.
class Copies {
 public:
  Copies(int vertices, const std::vector<Face>& face, const std::vector<Face>& texture)
      : texture_(static_cast<std::size_t>(vertices)), first_(static_cast<std::size_t>(vertices)) {
    for (std::size_t f = 0; f < face.size(); ++f)
      for (int c = 0; c < corner_count(face[f]); ++c) {
        std::vector<int>& of_vertex = texture_[face[f][c]];
        if (std::find(of_vertex.begin(), of_vertex.end(), texture[f][c]) == of_vertex.end())
          of_vertex.push_back(texture[f][c]);
      }
    int next = 0;
    for (std::size_t v = 0; v < texture_.size(); ++v) {
      if (texture_[v].empty()) texture_[v].push_back(-1);
      first_[v] = next;
      next += static_cast<int>(texture_[v].size());
    }
    count_ = next;
  }

  int count() const { return count_; }
  int first(int vertex) const { return first_[vertex]; }
  const std::vector<int>& textures(int vertex) const { return texture_[vertex]; }
  int copy(int vertex, int texture) const {
    const std::vector<int>& of_vertex = texture_[vertex];
    return first_[vertex] +
           static_cast<int>(std::find(of_vertex.begin(), of_vertex.end(), texture) - of_vertex.begin());
  }

 private:
  std::vector<std::vector<int>> texture_;
  std::vector<int> first_;
  int count_ = 0;
};

}  // namespace

void SoupBuilder::split_by_texture(PolygonSoup& soup) const {
  const Copies copies(vertices(), soup.face, texture_corner_);
  if (copies.count() > limits_.max_vertices)
    throw InputError(
        fmt::format("it has more than {} vertices, counted once for each of their texture coordinates; use "
                    "a coarser mesh",
                    limits_.max_vertices));
  std::vector<int> source;  // copy -> vertex
  Eigen::MatrixX2f uv = Eigen::MatrixX2f::Zero(copies.count(), 2);
  for (int v = 0; v < vertices(); ++v)
    for (const int texture : copies.textures(v)) {
      if (texture >= 0) uv.row(static_cast<Eigen::Index>(source.size())) = texture_[texture].transpose();
      source.push_back(v);
    }
  soup.layout.face = soup.face;
  soup.layout.uv = rows_of<Eigen::MatrixX2f>(texture_);
  soup.layout.uv_corner = texture_corner_;
  for (int v = 0; v < vertices(); ++v) soup.layout.vertex.push_back(copies.first(v));
  soup.position = Eigen::MatrixX3d(soup.position(source, Eigen::all));
  if (soup.colour.rows() > 0) soup.colour = Eigen::MatrixX3f(soup.colour(source, Eigen::all));
  for (auto& [name, weight] : soup.weight) weight = Eigen::VectorXf(weight(source));
  for (std::size_t f = 0; f < soup.face.size(); ++f)
    for (int c = 0; c < corner_count(soup.layout.face[f]); ++c)
      soup.face[f][c] = copies.copy(soup.layout.face[f][c], texture_corner_[f][c]);
  for (auto& [name, members] : soup.group) {
    std::vector<int> all;
    for (const int v : members)
      for (std::size_t k = 0; k < copies.textures(v).size(); ++k) all.push_back(copies.first(v) + static_cast<int>(k));
    members = std::move(all);
  }
  soup.uv = std::move(uv);
}

PolygonSoup SoupBuilder::soup() {
  if (face_.empty()) throw InputError("it has no polygons; export the mesh with its faces");
  PolygonSoup soup;
  soup.position = rows_of<Eigen::MatrixX3d>(position_);
  if (!uv_.empty()) {
    uv_.resize(position_.size(), Eigen::Vector2f::Zero());
    soup.uv = rows_of<Eigen::MatrixX2f>(uv_);
  }
  if (!colour_.empty()) {
    colour_.resize(position_.size(), Eigen::Vector3f::Ones());
    soup.colour = rows_of<Eigen::MatrixX3f>(colour_);
  }
  for (auto& [name, list] : weight_) {
    list.resize(position_.size(), 0.0f);
    soup.weight[name] = Eigen::VectorXf::Map(list.data(), static_cast<Eigen::Index>(list.size()));
  }
  soup.face = std::move(face_);
  soup.group = std::move(group_);
  for (auto& [name, members] : soup.group) {
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
  }
  if (!material_.empty()) soup.face_material = std::move(face_material_);
  soup.material = std::move(material_);
  soup.ignored = std::move(ignored_);
  if (!texture_.empty()) split_by_texture(soup);
  return soup;
}

}  // namespace billow::sim
