// A polygon mesh in memory: what an importer delivers, welded by position.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "sim/mesh/face.h"
#include "sim/mesh/file_layout.h"
#include "sim/mesh/material.h"

namespace billow::sim {

/// Polygons as a file lists them: each corner may have its own copy of a position.
struct PolygonSoup {
  Eigen::MatrixX3d position;                      // [m] (r x 3) raw vertices, copies included
  Eigen::MatrixX2f uv;                            //     (r x 2) or (0 x 2) where the file has none
  Eigen::MatrixX3f colour;                        //     (r x 3) in [0, 1], or (0 x 3)
  bool linear_colour = false;                     //     whether that is linear light, or else sRGB
  std::vector<Face> face;                         //     (f)     raw vertex indices
  std::map<std::string, std::vector<int>> group;  //     group or material name -> raw vertices, ascending
  std::map<std::string, Eigen::VectorXf> weight;  //     name -> (r) a number per raw vertex
  std::vector<Material> material;                 //     (m)
  std::vector<int> face_material;                 //     (f)     row of material, -1: none; empty: none anywhere
  std::vector<std::string> ignored;               //     what the file has and billow does not use, one phrase each
  FileLayout layout;                              //     of raw vertices; empty: they are the file's own
};

/// A mesh whose vertices are distinct positions, with texture coordinates kept per corner.
/// v vertices, f faces. Vertices are numbered in the file's own order.
struct Mesh {
  Eigen::MatrixX3d position;                       // [m] (v x 3)
  std::vector<Face> face;                          //     (f)
  std::vector<std::array<Eigen::Vector2f, 4>> uv;  //     (f) one per corner; empty where the file has none
  Eigen::MatrixX3f colour;                         //     (v x 3) in [0, 1], or (0 x 3)
  bool linear_colour = false;                      //     whether that is linear light, or else sRGB
  std::map<std::string, std::vector<int>> group;   //     name -> vertices, ascending
  std::map<std::string, Eigen::VectorXf> weight;   //     name -> (v) a number per vertex
  std::vector<Material> material;                  //     (m)
  std::vector<int> face_material;                  //     (f) row of material, -1: none; empty: none anywhere
  std::vector<std::string> ignored;                //     what its file has and billow does not use
  FileLayout layout;                               //     of its file; empty where it has none

  int vertices() const { return static_cast<int>(position.rows()); }
};

/// Joins vertices at the same position (each raw vertex to the nearest earlier one within 1e-6 of the bounding box's
/// diagonal), drops faces that collapse (a quad may become a triangle), and keeps texture coordinates per corner.
/// Vertices keep the order of their first raw copy; vertices that no face uses are dropped. Throws InputError on a
/// non-finite coordinate or a mesh with no face.
Mesh weld(const PolygonSoup& soup);

/// The mesh moved, its file's loose vertices too: position -> A * position + translation. Order is kept; where A
/// mirrors, faces are turned so that their front stays outside.
Mesh transformed(const Mesh& mesh, const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation);

/// Mean length [m] of the mesh's distinct edges.
double mean_edge_length(const Mesh& mesh);

}  // namespace billow::sim
