// Boxes around a part's moving triangles, in a tree: which triangles can come near which.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "sim/contact/contact_surface.h"

namespace billow::sim {

/// An axis-aligned box [m] whose sides go evenly from where they are now (the first three numbers) to where they are
/// then (the last three). Whatever goes evenly and is in it at both ends is in it all the while. In single precision,
/// rounded outward.
struct MovingBox {
  std::array<float, 6> low, high;

  /// Holds nothing.
  static MovingBox none() {
    MovingBox box;
    box.low.fill(INFINITY), box.high.fill(-INFINITY);
    return box;
  }
  void add(const MovingBox& other) {
    for (int k = 0; k < 6; ++k) low[k] = std::min(low[k], other.low[k]), high[k] = std::max(high[k], other.high[k]);
  }
  /// False where one axis keeps them apart at both ends, and so in between.
  bool meets(const MovingBox& other) const {
    bool apart = false;
    for (int k = 0; k < 3; ++k) {
      const bool above = low[k] >= other.high[k], stays_above = low[k + 3] >= other.high[k + 3];
      const bool below = other.low[k] >= high[k], stays_below = other.low[k + 3] >= high[k + 3];
      apart |= (above & stays_above) | (below & stays_below);
    }
    return !apart;
  }
};

/// Two triangles, numbered in the whole surface.
using FacePair = std::pair<int, int>;

/// A binary tree over one part, built by halves along the longest axis from where the surface rests: neighbours stay
/// neighbours whatever the motion, so it is only refitted.
class BoxTree {
 public:
  BoxTree(const ContactSurface& surface, const SurfacePart& part);

  /// Boxes around the triangles whose corners go from `now` to `then` (N) [m], each wider by the largest `reach` (N)
  /// [m] of its corners.
  void refit(const Points& now, const Points& then, const std::vector<double>& reach);

  /// The same where only the corners of these triangles have changed.
  void refit_some(const std::vector<int>& faces, const Points& now, const Points& then,
                  const std::vector<double>& reach);
  /// Appends the triangles whose boxes meet the box of `face` of `tree`, that one included.
  void add_meeting(const BoxTree& tree, int face, std::vector<int>& out) const;

  /// Two subtrees whose triangles are still to be paired.
  struct Task {
    const BoxTree *a, *b;
    int node_a, node_b;
  };
  /// Appends what pairing `a` with `b` (the same: with itself) falls into; boxes that do not meet are left out. Depends
  /// on the trees alone.
  static void split(const BoxTree& a, const BoxTree& b, std::vector<Task>& tasks);
  /// Appends the pairs of triangles whose boxes meet, each once, in an order that the trees fix.
  static void pairs(const Task& task, std::vector<FacePair>& out);

 private:
  struct Node {
    MovingBox box = MovingBox::none();
    int parent = -1;
    int right = 0;             // its right child, the left one following it; 0: a leaf
    int first = 0, count = 0;  // a leaf's triangles
  };
  void build(std::vector<Eigen::Vector3d>& middle, int first, int count, int parent);
  MovingBox box_of(int face, const Points& now, const Points& then, const std::vector<double>& reach) const;
  void fit(Node& node);
  bool is_leaf(int node) const { return node_[node].right == 0; }
  static bool descends_a(const Task& task);
  template <class Visit>
  static void visit_children(const Task& task, const Visit& visit);

  const ContactSurface& surface_;
  int first_face_;
  std::vector<int> order_;           // the triangles as the leaves have them
  std::vector<int> place_, leaf_;    // of each triangle: in that order; its node
  std::vector<MovingBox> face_box_;  // in that order
  std::vector<Node> node_;
};

}  // namespace billow::sim
