// What of a surface is near what, and how far everything may go before that must be looked at again.
#pragma once

#include <string>
#include <vector>

#include "sim/contact/box_tree.h"
#include "sim/contact/contact_pair.h"
#include "sim/contact/contact_surface.h"

namespace billow::sim {

/// One look at the surface, and the room that it leaves.
///
/// Every vertex gets a cell: a ball that travels with the mean motion of its part, and for each near pair that it
/// belongs to a half-space. Pairs that were not near are farther apart than two balls and what their parts' motions can
/// differ by until `expires`; the sides of a near pair have a plane between them. Balls and half-spaces are convex, so
/// two surfaces whose vertices go straight from one place in their cells to another never touch in between (the
/// displacement bound of offset-geometric contact, Chen et al. 2025, with planes in place of balls where things slide).
class Detection {
 public:
  explicit Detection(const ContactSurface& surface);

  /// Looks at the surface at `x` (N) [m] with velocities `v` (N) [m/s] at `time` [s]; steps of about h [s] follow.
  /// Vertices that move relative to their part are searched farther around, to leave them room for `steps` steps.
  void detect(const Points& x, const Points& v, double time, double h, double steps);
  /// The same for cells that stand still, so that a vertex may stop anywhere in its own: what `shares` is asked of.
  void detect_standing(const Points& x, const Points& v, double time, double h);
  /// The room must be found anew.
  void forget() { valid_ = false; }
  bool valid() const { return valid_; }
  double time() const { return time_; }
  /// Counts the detections so far.
  long number() const { return number_; }

  /// Near pairs, in an order that depends on the surface alone.
  const std::vector<ContactPair>& pairs() const { return pair_; }
  /// Whether the vertices at `y` (N) are in their cells at `time`.
  bool holds(const Points& y, double time);
  /// The share of the way `d` (N) [m] from the detected places that each vertex can go in its standing cell, into
  /// `share` (N), by the planes alone; and, returned, the share that all balls allow.
  double shares(const Points& d, std::vector<double>& share) const;

 private:
  void look(const Points& x, double h, double steps);
  void set_mean_velocities();
  void set_reach(double h, double steps);
  void set_expiry(double least);
  double rate_apart(std::size_t a, std::size_t b) const;
  void find_pairs(const Points& x);
  void find_rooms();
  bool within_bounds(const ContactPair& pair, const Points& y, double t) const;
  void narrow(const Points& x, const FacePair& faces, double gap, std::vector<ContactPair>& out) const;
  void add_point_face(const Points& x, int v, int f, double gap, std::vector<ContactPair>& out) const;
  void add_edge_edge(const Points& x, int e, int f, double gap, std::vector<ContactPair>& out) const;
  bool finish(const Points& x, double distance, ContactPair& pair) const;
  void put_plane(const Points& x, ContactPair& pair) const;
  double rest_distance(const ContactPair& pair) const;
  bool acts(int e, int f, const Eigen::Vector2d& at) const;
  bool owns(int face, const std::array<int, 3>& corner, const Eigen::Vector3d& weight, int v) const;

  const ContactSurface& surface_;
  std::vector<BoxTree> tree_;  // of each part
  bool valid_ = false;
  long number_ = 0;
  double time_ = 0.0, expires_ = 0.0;  // [s]
  Points x_, v_;                       // (N) [m], [m/s] at the detection
  Points part_velocity_;               // [m/s] of each part, the mean
  std::vector<double> room_, reach_;   // (N) [m] the ball's radius; how far around it was looked
  std::vector<float> stray_;           // (N) [m] how far from its part's motion
  /// Of a pair what mostly tells that its bounds hold, rounded to the safe side.
  struct Room {
    std::array<int, 4> vertex;
    int on_a;
    float slack_a, slack_b, loss_a, loss_b;
  };
  std::vector<ContactPair> pair_;
  std::vector<Room> pair_room_;
};

}  // namespace billow::sim
