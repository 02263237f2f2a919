// Which features of a surface can come near each other for a while.
#pragma once

#include <vector>

#include "sim/contact/box_tree.h"
#include "sim/contact/contact_surface.h"

namespace billow::sim {

/// A vertex and a triangle, or two edges.
struct Features {
  int on_a;                   // corners of the first: 1 or 2
  int first, second;          // numbered in the surface
  std::array<int, 4> vertex;  // the corners of the first, then of the second
};

/// Whether an axis keeps two features at least `apart` [m] from each other while their corners go evenly from `now` to
/// `then` (N) [m]: it does where it does at both ends, with the same one ahead.
bool are_kept_apart(const Features& features, const Points& now, const Points& then, double apart);

/// What a search of all features found, for as long as it stands for a new search: the trees are walked and a surface's
/// own neighbours, which never come near each other, are told apart from the rest once for many looks at what is left.
class Neighbourhood {
 public:
  explicit Neighbourhood(const ContactSurface& surface);

  /// When a look is made, when the step from there ends, and until when the look is to stand, all [s].
  struct Span {
    double time, next, last;
  };
  /// Makes sure that vertices within `margin` (N) [m] of `x` (N) [m], and of where they are at the end of the step if
  /// they go on with `v` (N) [m/s], are in the room that the last search left. Otherwise searches, around those alone
  /// that are leaving it where they are few. Returns whether it searched all.
  bool cover(const Points& x, const Points& v, const std::vector<double>& margin, const Span& span);
  /// Whether the vertices at `y` (N) are in that room at `time`: nothing that was not found can have met then.
  bool holds(const Points& y, double time) const;
  void forget() { valid_ = false; }

  /// [m] how far a vertex of the part may be from where it was expected, and the largest margin that it may have.
  double room(const SurfacePart& part) const;
  /// All features that are or may come within their thicknesses and margins, and others; in an order that
  /// the trees and the motion fix.
  const std::vector<Features>& features() const { return features_; }

 private:
  void find_strays(const Points& x, const Points& v, const std::vector<double>& margin, const Span& span);
  bool follow_strays(const Points& x, const Points& v, double time);
  void search_around(const std::vector<int>& faces);
  void search_around(int f, std::vector<Features>& found) const;
  void choose_ahead(double time, double ahead);
  void search(const Points& x, const Points& v, double time);
  void set_face_motion(int f);
  void find_features();
  void narrow(const FacePair& faces, std::vector<Features>& found) const;
  template <class Visit>
  void for_each_features(const FacePair& faces, const Visit& visit) const;
  Features point_face(int v, int f) const;
  Features edge_edge(int e, int f) const;
  bool may_meet(const Features& features, double approach) const;
  /// Pairs of triangles that share a vertex: around each vertex those of which it is the first that they share. Its
  /// ring is all other corners of the triangles around it.
  struct Rings {
    std::vector<int> first_pair, first_neighbour;  // (N + 1)
    std::vector<FacePair> pair;
    std::vector<int> neighbour;
    Points spoke;               // [m] of each neighbour, from the vertex to it when it was last looked at
    std::vector<double> apart;  // (N) [m] the nearest that features of its pairs were then; 0: not looked at
  };
  void find_rings();
  void search_ring(int w, bool changed_only, std::vector<Features>& found);
  bool are_paired(int p, int q) const;
  double ring_distance(int w) const;
  double ring_change(int w) const;
  double ring_speed(int w) const;

  const ContactSurface& surface_;
  std::vector<BoxTree> tree_;  // of each part
  Rings ring_;
  double edge_room_ = 0.0;     // [m] how far from where it was expected every vertex may be at least
  std::vector<double> reach_;  // (N) [m] how far around each was searched
  bool valid_ = false;
  double time_ = 0.0, ahead_ = 0.0;         // [s]
  Points x_, v_, then_;                     // (N) [m], [m/s] at the search; [m] where that leads
  Points face_velocity_;                    // [m/s] of each triangle, the mean of its corners'
  std::vector<double> face_spread_;         // [m/s] how far a corner's is from that
  std::vector<std::vector<int>> faces_of_;  // (N) the triangles around each vertex
  std::vector<int> answers_[2];             // for each vertex, for each edge: the triangle that does
  std::vector<int> stray_;                  // vertices that are leaving their room
  std::vector<char> changed_;               // of each triangle
  std::vector<Features> features_;
};

}  // namespace billow::sim
