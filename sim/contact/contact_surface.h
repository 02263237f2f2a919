// The surfaces of a scene that touch: bodies' and colliders' vertices, edges and triangles in one numbering.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "sim/body/structure.h"
#include "sim/contact/contact_options.h"

namespace billow::sim {

/// Points one beside the other in memory: pairs are gathered from all over.
using Points = std::vector<Eigen::Vector3d>;

/// One body's or collider's share of the surface.
struct SurfacePart {
  std::string name;
  int body = -1;      // its place in the structure; -1: a collider
  int collider = -1;  // its place among the colliders; -1: a body
  int first_vertex = 0, vertices = 0;
  int first_face = 0, faces = 0;
  bool self = false;       // touches itself
  double thickness = 0.0;  // [m] that it adds to the distance of a pair
  double radius = 0.0;     // [m] of what is solid around its vertex or its edge; 0: its triangles are the surface
  double friction = 0.0;
  double edge_length = 0.0;  // [m] the mean

  bool is_body() const { return collider < 0; }
  bool rounded() const { return radius > 0.0; }
};

/// What a triangle answers for, so that every vertex and edge is answered for once (Curtis, Tamstorf & Manocha 2008).
struct FaceShare {
  int vertices = 0, edges = 0;
  std::array<int, 3> vertex{}, edge{};
};

/// N vertices: the structure's particles, then the colliders' vertices. Half-spaces have none and stand apart;
/// something rounded has the ends of its segment and one face, which names them more than once.
struct ContactSurface {
  ContactSurface(const Structure& structure, const ContactOptions& options);

  int vertices() const { return static_cast<int>(rest.size()); }

  int particles = 0;
  std::vector<SurfacePart> part;
  std::vector<int> part_of;              // (N) the vertex's part; -1: it touches nothing
  std::vector<double> inverse_mass;      // (N) [1/kg] 0: moved by no contact
  Points rest;                           // (N) [m]
  std::vector<std::array<int, 3>> face;  // by part
  std::vector<int> polygon;              // of each face: the face of its part's mesh that it is cut from
  std::vector<std::array<int, 2>> edge;  // by part
  std::vector<FaceShare> share;          // of each face
  std::vector<int> first_edge;           // (N) of each vertex, which answers for it where edges are what is touched
  std::vector<int> half_space;           // places among the colliders
};

}  // namespace billow::sim
