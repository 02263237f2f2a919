// Boxes around a part's triangles, in a tree: which triangles can be near which.
#pragma once

#include <utility>
#include <vector>

#include "sim/contact/contact_surface.h"

namespace billow::sim {

/// An axis-aligned box [m].
struct Box {
  Eigen::Array3d low = Eigen::Array3d::Constant(INFINITY), high = Eigen::Array3d::Constant(-INFINITY);

  void add(const Eigen::Vector3d& point) { low = low.min(point.array()), high = high.max(point.array()); }
  void add(const Box& other) { low = low.min(other.low), high = high.max(other.high); }
  /// Whether the boxes come nearer than `gap` [m] in every axis.
  bool near(const Box& other, double gap) const {
    return low(0) - other.high(0) < gap && other.low(0) - high(0) < gap && low(1) - other.high(1) < gap &&
           other.low(1) - high(1) < gap && low(2) - other.high(2) < gap && other.low(2) - high(2) < gap;
  }
};

/// Two triangles, numbered in the whole surface.
using FacePair = std::pair<int, int>;

/// A binary tree over one part, built by halves along the longest axis from where the surface rests: neighbours stay
/// neighbours whatever the motion, so it is only refitted.
class BoxTree {
 public:
  BoxTree(const ContactSurface& surface, const SurfacePart& part);

  /// Boxes around the triangles at `x` (N), each wider by the largest `reach` (N) [m] of its corners.
  void refit(const Points& x, const std::vector<double>& reach);

  /// Two subtrees whose triangles are still to be paired.
  struct Task {
    const BoxTree *a, *b;
    int node_a, node_b;
  };
  /// Appends what pairing `a` with `b` (the same: with itself) falls into; boxes farther apart than `gap` [m] are left
  /// out. Depends on the trees alone.
  static void split(const BoxTree& a, const BoxTree& b, double gap, std::vector<Task>& tasks);
  /// Appends the pairs of triangles with near boxes, each once, in an order that the trees fix.
  static void pairs(const Task& task, double gap, std::vector<FacePair>& out);

  const Box& box() const { return node_[0].box; }

 private:
  struct Node {
    Box box = {};
    int right = 0;             // its right child, the left one following it; 0: a leaf
    int first = 0, count = 0;  // a leaf's triangles
  };
  void build(std::vector<Eigen::Vector3d>& middle, int first, int count);
  bool is_leaf(int node) const { return node_[node].right == 0; }
  static bool descends_a(const Task& task);
  template <class Visit>
  static void visit_children(const Task& task, double gap, const Visit& visit);

  const ContactSurface& surface_;
  int first_face_;
  std::vector<int> order_;     // the triangles as the leaves have them
  std::vector<Box> face_box_;  // in that order
  std::vector<Node> node_;
};

}  // namespace billow::sim
