// Features -> planes and balls.
#include "sim/contact/detection.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "sim/contact/closest_points.h"

namespace billow::sim {

namespace {

// Of its thickness: how far a vertex may stray from its way at least.
constexpr double least_margin = 0.5;
// Of an edge: where thickness is more, a surface's own neighbours are within it.
constexpr double wide_edges = 0.2;
// Where surfaces rest on a body's own, thickness is no more than this share of how far apart they rest.
constexpr double rest_share = 0.9;

}  // namespace

Detection::Detection(const ContactSurface& surface)
    : surface_(surface),
      neighbourhood_(surface),
      then_(surface.rest.size()),
      margin_(surface.rest.size()),
      reach_(surface.rest.size()),
      room_(surface.rest.size()),
      stray_(surface.rest.size()) {}

// `way` (N) [m] is how far a vertex may stray, as far as that is known.
void Detection::set_margin(const Points* way) {
  for (const SurfacePart& part : surface_.part) {
    const double least = least_margin * part.thickness, most = neighbourhood_.room(part);
    for (int i = part.first_vertex; i < part.first_vertex + part.vertices; ++i) {
      margin_[i] = way ? std::clamp((*way)[i].norm(), least, most) : least;
      reach_[i] = part.radius + part.thickness + margin_[i];
      room_[i] = (1.0 - least_share) * part.thickness + margin_[i];
    }
  }
}

void Detection::detect(const Points& x, const Points& v, double time, double h, double steps) {
  set_margin(nullptr);
  x_ = x, v_ = v, time_ = time;
  constexpr double rounding = 1e-9;
  look(h, (1.0 + rounding) * steps * h);
}

void Detection::detect_standing(const Points& x, const Points& way, double time) {
  set_margin(&way);
  x_ = x, v_.assign(x.size(), Eigen::Vector3d::Zero()), time_ = time;
  constexpr double moment = 1e-9;  // [s] nothing moves
  look(0.0, moment);
}

// `h` [s] is how long the cells must hold at least.
void Detection::look(double h, double ahead) {
  expires_ = time_ + ahead;
  for (std::size_t i = 0; i < x_.size(); ++i) then_[i] = x_[i] + ahead * v_[i];
  if (neighbourhood_.cover(x_, v_, margin_, {.time = time_, .next = time_ + h, .last = expires_})) ++searches_;
  find_pairs();
  valid_ = true;
  ++number_;
}

// Cut and joined in the features' order, whichever thread takes which part.
void Detection::find_pairs() {
  const std::vector<Features>& features = neighbourhood_.features();
  std::vector<std::vector<ContactPair>> found(most_parts());
  for_each_range(static_cast<int>(features.size()), 1, least_part_of_a_pass, [&](int part, int begin, int end) {
    for (int k = begin; k < end; ++k) add(features[k], found[part]);
  });
  pair_.clear(), pair_room_.clear();
  for (const auto& some : found) pair_.insert(pair_.end(), some.begin(), some.end());
  for (const ContactPair& pair : pair_) pair_room_.push_back(room_of(pair));
}

void Detection::add(const Features& features, std::vector<ContactPair>& found) const {
  const auto& v = features.vertex;
  double reach[2] = {0.0, 0.0};
  for (int k = 0; k < 4; ++k) reach[k >= features.on_a] = std::max(reach[k >= features.on_a], reach_[v[k]]);
  const double near = reach[0] + reach[1];
  if (are_kept_apart(features, x_, then_, near)) return;
  ContactPair pair{.vertex = v, .weight = {}, .on_a = features.on_a};
  const auto [weight, difference] = nearest_points(v, pair.on_a, x_);
  const double approach = (expires_ - time_) * largest_difference(pair);
  if (difference.squaredNorm() >= (near + approach) * (near + approach)) return;
  pair.weight = weight;
  settle(features, difference, pair);
  found.push_back(pair);
}

// [m/s] by which velocities of the two sides' corners differ: nearest points come no faster nearer.
double Detection::largest_difference(const ContactPair& pair) const {
  double square = 0.0;
  for (int k = 0; k < pair.on_a; ++k)
    for (int l = pair.on_a; l < 4; ++l)
      square = std::max(square, (v_[pair.vertex[k]] - v_[pair.vertex[l]]).squaredNorm());
  return std::sqrt(square);
}

// What follows from the nearest points: normal, thickness, friction, the plane.
void Detection::settle(const Features& features, const Eigen::Vector3d& difference, ContactPair& pair) const {
  const auto& v = pair.vertex;
  const double distance = difference.norm();
  if (distance > 0.0)
    pair.normal = difference / distance;
  else
    pair.normal = (x_[v[1]] - (pair.on_a == 1 ? x_[v[2]] : x_[v[0]])).cross(x_[v[3]] - x_[v[2]]).normalized();
  pair.acts = pair.on_a == 1 ? owns(features.second, pair) : acts(features.first, features.second, pair);
  const SurfacePart &a = surface_.part[surface_.part_of[v[0]]], &b = surface_.part[surface_.part_of[v[pair.on_a]]];
  pair.thickness = a.thickness + b.thickness;
  if (&a == &b) {
    const double wide = pair.thickness;
    if (distance < wide || wide > wide_edges * a.edge_length)
      pair.thickness = std::min(wide, rest_share * nearest_points(v, pair.on_a, surface_.rest).difference.norm());
  }
  pair.radius = a.radius + b.radius;
  pair.friction = std::sqrt(a.friction * b.friction);
  put_plane(pair);
}

// Whether the face answers for the nearest point of v on it: its inside always, an edge or a corner where they are its
// share, and between two vertices one of the two looks.
bool Detection::owns(int f, const ContactPair& pair) const {
  const FaceShare& share = surface_.share[f];
  const std::array<int, 3>& corner = surface_.face[f];
  const int v = pair.vertex[0];
  const auto weight = [&](int k) { return -pair.weight[k + 1]; };
  const int zeros = (weight(0) == 0.0) + (weight(1) == 0.0) + (weight(2) == 0.0);
  if (zeros == 0) return true;
  if (zeros == 2) {
    const int w = corner[weight(0) > 0.0 ? 0 : weight(1) > 0.0 ? 1 : 2];
    const bool looks = v < w || surface_.part[surface_.part_of[v]].rounded();
    return looks && std::find(share.vertex.begin(), share.vertex.begin() + share.vertices, w) !=
                        share.vertex.begin() + share.vertices;
  }
  const int out = weight(0) == 0.0 ? 0 : weight(1) == 0.0 ? 1 : 2;
  const int first = corner[(out + 1) % 3], second = corner[(out + 2) % 3];
  const std::array<int, 2> edge{std::min(first, second), std::max(first, second)};
  return std::any_of(share.edge.begin(), share.edge.begin() + share.edges,
                     [&](int e) { return surface_.edge[e] == edge; });
}

// Two edges stand for their inner points. For where an edge of something rounded meets a vertex no triangle does, so
// one of that vertex's edges must.
bool Detection::acts(int e, int f, const ContactPair& pair) const {
  const double at_e = pair.weight[1], at_f = -pair.weight[3];
  const auto answers = [&](int edge, double share) {
    return (share > 0.0 && share < 1.0) || surface_.first_edge[surface_.edge[edge][share > 0.0]] == edge;
  };
  const auto rounded = [&](int edge) { return surface_.part[surface_.part_of[surface_.edge[edge][0]]].rounded(); };
  const bool inner_e = at_e > 0.0 && at_e<1.0, inner_f = at_f> 0.0 && at_f < 1.0;
  if (rounded(e)) return inner_e && answers(f, at_f);
  if (rounded(f)) return inner_f && answers(e, at_e);
  return inner_e && inner_f;
}

// Between the corners as they are and as their velocities lead them until the look expires, so that it is right however
// roughly the nearest points were found. In between it goes evenly: sides whose corners go evenly are apart at least as
// far as at one of the two ends. Where one side cannot be held up, it gets little of the room, and all that it will
// take.
void Detection::put_plane(ContactPair& pair) const {
  double low = INFINITY, high = -INFINITY, low_then = INFINITY, high_then = -INFINITY;
  bool a_moves = false, b_moves = false;
  for (int k = 0; k < 4; ++k) {
    const int v = pair.vertex[k];
    const double height = pair.normal.dot(x_[v]), then = pair.normal.dot(then_[v]);
    const bool free = surface_.inverse_mass[v] > 0.0;
    if (k < pair.on_a)
      low = std::min(low, height), low_then = std::min(low_then, then), a_moves = a_moves || free;
    else
      high = std::max(high, height), high_then = std::max(high_then, then), b_moves = b_moves || free;
  }
  const double kept = pair.radius + least_share * pair.thickness;
  const double between = std::max(0.0, low - high - kept), between_then = low_then - high_then - kept;
  const double share_a = a_moves == b_moves ? 0.5 : a_moves ? 0.9 : 0.1;
  pair.slack_a = share_a * between;
  pair.slack_b = between - pair.slack_a;
  double slack_a_then = share_a * between_then;
  if (between_then < between && a_moves != b_moves) slack_a_then = a_moves ? between_then - pair.slack_b : pair.slack_a;
  const double ahead = expires_ - time_;
  pair.bound_a = low - pair.slack_a;
  pair.bound_b = high + pair.slack_b;
  pair.drift = (low_then - slack_a_then - pair.bound_a) / ahead;
  pair.loss_a = (pair.slack_a - slack_a_then) / ahead;
  pair.loss_b = (pair.slack_b - (between_then - slack_a_then)) / ahead;
}

bool Detection::has_room(const Points& y, double time) const {
  if (!valid_ || time > expires_ || !neighbourhood_.holds(y, time)) return false;
  const double t = time - time_;
  for (const SurfacePart& part : surface_.part)
    for (int i = part.first_vertex; i < part.first_vertex + part.vertices; ++i)
      if (!((y[i] - x_[i] - t * v_[i]).squaredNorm() <= room_[i] * room_[i])) return false;
  return true;
}

bool Detection::holds(const Points& y, double time) {
  if (!has_room(y, time)) return false;
  const double t = time - time_;
  for (const SurfacePart& part : surface_.part)
    for (int i = part.first_vertex; i < part.first_vertex + part.vertices; ++i)
      stray_[i] = static_cast<float>((y[i] - x_[i] - t * v_[i]).norm());
  const auto passed = static_cast<float>(t);
  for (std::size_t p = 0; p < pair_.size(); ++p) {
    const Room& room = pair_room_[p];
    float most[2] = {0.0f, 0.0f};
    for (int k = 0; k < 4; ++k) most[k >= room.on_a] = std::max(most[k >= room.on_a], stray_[room.vertex[k]]);
    if (most[0] + passed * room.loss_a < room.slack_a && most[1] + passed * room.loss_b < room.slack_b) continue;
    if (!within_bounds(pair_[p], y, t)) return false;
  }
  return true;
}

bool Detection::within_bounds(const ContactPair& pair, const Points& y, double t) const {
  for (int k = 0; k < 4; ++k) {
    const double height = pair.normal.dot(y[pair.vertex[k]]) - pair.drift * t;
    if (k < pair.on_a ? height < pair.bound_a : height > pair.bound_b) return false;
  }
  return true;
}

// Single precision is off by less than what is taken off and added here.
Detection::Room Detection::room_of(const ContactPair& pair) {
  constexpr double rounding = 1e-5;
  const auto more = [](double value) { return static_cast<float>(value + rounding * std::abs(value)); };
  const auto less = [](double value) { return static_cast<float>(value - rounding * std::abs(value)); };
  return {.vertex = pair.vertex,
          .on_a = pair.on_a,
          .slack_a = less(pair.slack_a),
          .slack_b = less(pair.slack_b),
          .loss_a = more(pair.loss_a),
          .loss_b = more(pair.loss_b)};
}

double Detection::shares(const Points& d, std::vector<double>& share) const {
  share.assign(d.size(), 1.0);
  double all = 1.0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (surface_.part_of[i] < 0) continue;
    const double length = d[i].norm();
    if (length > room_[i]) all = std::min(all, room_[i] / length);
  }
  for (const ContactPair& pair : pair_)
    for (int k = 0; k < 4; ++k) {
      const int i = pair.vertex[k];
      const double way = pair.normal.dot(d[i]), height = pair.normal.dot(x_[i]);
      const double room = std::max(0.0, k < pair.on_a ? height - pair.bound_a : pair.bound_b - height);
      const double toward = k < pair.on_a ? -way : way;
      if (toward > room) share[i] = std::min(share[i], room / toward);
    }
  return all;
}

}  // namespace billow::sim
