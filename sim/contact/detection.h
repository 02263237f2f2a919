// What of a surface is near what, and how far everything may go before that must be looked at again.
#pragma once

#include <array>
#include <vector>

#include "sim/contact/contact_pair.h"
#include "sim/contact/contact_surface.h"
#include "sim/contact/neighbourhood.h"

namespace billow::sim {

/// One look at the surface, and the room that it leaves.
///
/// Every vertex gets a cell: a ball that goes on with the vertex's velocity as it was, and for each near pair that it
/// belongs to a half-space that moves evenly too. Pairs that were not near are kept apart by more than two balls until
/// the look expires; the sides of a near pair have a plane between them. Balls and half-spaces are convex, so two
/// surfaces whose vertices go straight from one place in their cells to another never touch in between (the
/// displacement bound of offset-geometric contact, Chen et al. 2025, with balls that move as their vertices do and
/// planes where things slide).
class Detection {
 public:
  explicit Detection(const ContactSurface& surface);

  /// Looks at the surface at `x` (N) [m] with velocities `v` (N) [m/s] at `time` [s], for so many steps of h [s] ahead.
  void detect(const Points& x, const Points& v, double time, double h, double steps);
  /// The same for cells that stand still, so that a vertex may stop anywhere in its own: what `shares` is asked of.
  /// Around each it is looked as far as its `way` (N) [m], within limits.
  void detect_standing(const Points& x, const Points& way, double time);
  /// The room must be found anew.
  void expire() { valid_ = false; }
  /// And nothing follows from what was.
  void forget() { valid_ = false, neighbourhood_.forget(); }
  bool valid() const { return valid_; }
  double time() const { return time_; }
  /// [s] until when it stands at the longest.
  double expires() const { return expires_; }
  /// So far: looks, and searches of all features among them.
  long number() const { return number_; }
  long searches() const { return searches_; }

  /// Near pairs, in an order that no number of threads changes.
  const std::vector<ContactPair>& pairs() const { return pair_; }
  /// Whether the vertices at `y` (N) are in their balls at `time`.
  bool has_room(const Points& y, double time) const;
  /// And in their whole cells.
  bool holds(const Points& y, double time);
  /// The share of the way `d` (N) [m] from the detected places that each vertex can go in its standing cell, into
  /// `share` (N), by the planes alone; and, returned, the share that all balls allow.
  double shares(const Points& d, std::vector<double>& share) const;

 private:
  void look(double h, double ahead);
  void set_margin(const Points* way);
  void find_pairs();
  void add(const Features& features, std::vector<ContactPair>& found) const;
  double largest_difference(const ContactPair& pair) const;
  bool within_bounds(const ContactPair& pair, const Points& y, double t) const;
  void settle(const Features& features, const Eigen::Vector3d& difference, ContactPair& pair) const;
  void put_plane(ContactPair& pair) const;
  bool acts(int e, int f, const ContactPair& pair) const;
  bool owns(int f, const ContactPair& pair) const;

  const ContactSurface& surface_;
  Neighbourhood neighbourhood_;
  bool valid_ = false;
  long number_ = 0, searches_ = 0;
  double time_ = 0.0, expires_ = 0.0;          // [s]
  Points x_, v_, then_;                        // (N) [m], [m/s] at the look; [m] where that leads until it expires
  std::vector<double> margin_, reach_, room_;  // (N) [m] around the vertex; with its thickness; the ball's radius
  std::vector<float> stray_;                   // (N) [m] how far from there
  /// Of a pair what mostly tells that its bounds hold, rounded to the safe side.
  struct Room {
    std::array<int, 4> vertex;
    int on_a;
    float slack_a, slack_b, loss_a, loss_b;
  };
  static Room room_of(const ContactPair& pair);
  std::vector<ContactPair> pair_;
  std::vector<Room> pair_room_;
};

}  // namespace billow::sim
