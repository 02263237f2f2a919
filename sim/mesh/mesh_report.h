// A look at a mesh: what it consists of, and what of it will make trouble.
#pragma once

#include <Eigen/Geometry>
#include <string_view>
#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// How often something occurs, and where the first few are.
struct Places {
  static constexpr int shown = 3;
  int count = 0;
  std::vector<Eigen::Vector3d> first;  // [m] at most `shown`

  void add(const Eigen::Vector3d& place) {
    if (count++ < shown) first.push_back(place);
  }
};

struct MeshReport {
  /// A part that hangs together, or a border that closes.
  struct Piece {
    int vertices = 0, faces = 0;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // [m] mean of its vertices
  };
  struct Border {
    int edges = 0;
    double length = 0.0;                               // [m]
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // [m]
  };

  int vertices = 0, triangles = 0, quads = 0, edges = 0;
  int file_vertices = 0, loose_vertices = 0;  // of the file: all, copies included; those of no face
  int dropped_faces = 0;                      // of the file: those that collapsed to nothing
  Eigen::AlignedBox3d box;                    // [m]
  double shortest_edge = 0.0, mean_edge = 0.0, longest_edge = 0.0;  // [m]
  double area = 0.0;                                                // [m^2]
  double volume = 0.0;                                              // [m^3] inside; 0 unless closed
  std::vector<Piece> pieces;                                        // the largest first
  std::vector<Border> borders;                                      // the longest first
  bool has_uv = false;
  Places seams;            // edges at which the texture coordinates of two faces differ
  Places crowded_edges;    // of more than two faces
  Places turned_edges;     // whose two faces face opposite ways
  Places duplicate_faces;  // with the same vertices as an earlier one
  Places flat_faces;       // without an area, but for rounding
  Places tiny_edges;       // shorter than a thousandth of the mean

  bool closed() const { return borders.empty() && crowded_edges.count == 0; }
  /// Borders beyond one for each open piece.
  int holes() const;
};

MeshReport report_of(const Mesh& mesh);

/// What one unit of the file's coordinates most likely is, where that is not a metre: "cm" or "mm" for things that
/// would be larger than a house; "" otherwise. `box` is the file's.
std::string_view likely_unit(const Eigen::AlignedBox3d& box);

}  // namespace billow::sim
