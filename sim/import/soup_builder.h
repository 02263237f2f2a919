// Where readers put what they find, under the limits of an import.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/import/mesh_import.h"

namespace billow::sim {

/// Collects a mesh's raw vertices and polygons; throws InputError as soon as there are more than `limits` allow.
class SoupBuilder {
 public:
  explicit SoupBuilder(const ImportLimits& limits) : limits_(limits) {}

  int vertices() const { return static_cast<int>(position_.size()); }
  int faces() const { return static_cast<int>(face_.size()); }

  /// Adds a vertex and returns its number.
  int add_vertex(const Eigen::Vector3d& position);
  /// Of the latest vertices, or of any: values that are given to none read 0, colours white.
  void set_uv(int vertex, const Eigen::Vector2f& uv);
  void set_colour(int vertex, const Eigen::Vector3f& colour);
  void set_weight(int vertex, const std::string& name, float weight);

  /// Adds a texture coordinate that corners of faces may name, and returns its number.
  int add_texture(const Eigen::Vector2f& uv);
  int textures() const { return static_cast<int>(texture_.size()); }

  /// A polygon's corners as vertices, and as texture coordinates or nothing.
  struct Polygon {
    std::vector<long long> corner;
    std::vector<long long> texture = {};  // as many, or none
    int material = -1;
    int line = 0;  // of a text, 0: none
  };
  /// Adds a polygon of any number of corners, as the faces it becomes; fewer than three are nothing. Throws
  /// InputError on a corner that is no vertex so far.
  void add_polygon(const Polygon& polygon);
  /// Adds a vertex to a group.
  void add_member(const std::string& group, int vertex) { group_[group].push_back(vertex); }

  /// Adds a material and returns its number.
  int add_material(Material material);
  /// Something that the file has and billow does not use.
  void ignore(const std::string& what);

  /// What was collected; where corners have texture coordinates of their own, with a raw copy of a vertex for each that
  /// it has. Throws InputError where there is no polygon.
  PolygonSoup soup();

 private:
  void split_by_texture(PolygonSoup& soup) const;

  const ImportLimits& limits_;
  std::vector<Eigen::Vector3d> position_;
  std::vector<Eigen::Vector2f> uv_;
  std::vector<Eigen::Vector3f> colour_;
  std::map<std::string, std::vector<float>> weight_;
  std::vector<Face> face_;
  std::vector<int> face_material_;
  std::vector<Eigen::Vector2f> texture_;
  std::vector<Face> texture_corner_;  // per face, -1: none
  std::map<std::string, std::vector<int>> group_;
  std::vector<Material> material_;
  std::vector<std::string> ignored_;
};

}  // namespace billow::sim
