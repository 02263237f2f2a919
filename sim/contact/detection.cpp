// Boxes -> features -> planes and balls.
#include "sim/contact/detection.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "sim/contact/closest_points.h"

namespace billow::sim {

namespace {

// Of what a pair is thick: what its sides never come nearer than.
constexpr double least_share = 0.1;
// Of an edge: looking farther finds a cloth's own neighbours everywhere.
constexpr double farthest_edges = 0.2;
// Of its thickness: a vertex that rests is searched around for at least so much.
constexpr double nearest_thicknesses = 0.5;
// Where surfaces rest on a body's own, thickness is no more than this share of how far apart they rest.
constexpr double rest_share = 0.9;

bool has(const std::array<int, 3>& face, int v) { return face[0] == v || face[1] == v || face[2] == v; }

}  // namespace

Detection::Detection(const ContactSurface& surface)
    : surface_(surface), room_(surface.rest.size()), reach_(surface.rest.size()), stray_(surface.rest.size()) {
  for (const SurfacePart& part : surface.part) tree_.emplace_back(surface, part);
  part_velocity_.assign(surface.part.size(), Eigen::Vector3d::Zero());
}

// Over each part, in order.
void Detection::set_mean_velocities() {
  for (std::size_t p = 0; p < surface_.part.size(); ++p) {
    const SurfacePart& part = surface_.part[p];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = part.first_vertex; i < part.first_vertex + part.vertices; ++i) sum += v_[i];
    part_velocity_[p] = sum / std::max(1, part.vertices);
  }
}

void Detection::set_reach(double h, double steps) {
  for (std::size_t p = 0; p < surface_.part.size(); ++p) {
    const SurfacePart& part = surface_.part[p];
    const double least = nearest_thicknesses * part.thickness;
    const double most = std::max({farthest_edges * part.edge_length, part.thickness, least});
    for (int i = part.first_vertex; i < part.first_vertex + part.vertices; ++i) {
      const double margin = std::clamp(steps * h * (v_[i] - part_velocity_[p]).norm(), least, most);
      reach_[i] = part.radius + part.thickness + margin;
      room_[i] = (1.0 - least_share) * part.thickness + margin;
    }
  }
}

void Detection::detect(const Points& x, const Points& v, double time, double h, double steps) {
  v_ = v, time_ = time;
  set_mean_velocities();
  look(x, h, steps);
}

// The parts' motions are none, and so are the planes'.
void Detection::detect_standing(const Points& x, const Points& v, double time, double h) {
  v_ = v, time_ = time;
  std::fill(part_velocity_.begin(), part_velocity_.end(), Eigen::Vector3d::Zero());
  look(x, h, 1.0);
}

void Detection::look(const Points& x, double h, double steps) {
  x_ = x;
  set_reach(h, steps);
  set_expiry(steps * h);
  for (BoxTree& tree : tree_) tree.refit(x, reach_);
  find_pairs(x);
  find_rooms();
  valid_ = true;
  ++number_;
}

// Parts that move alike may go on for long before their motions differ by what was searched for.
void Detection::set_expiry(double least) {
  double life = INFINITY;
  const auto& part = surface_.part;
  for (std::size_t a = 0; a < part.size(); ++a)
    for (std::size_t b = a + 1; b < part.size(); ++b) {
      const double rate = rate_apart(a, b);
      if (rate > 0.0) life = std::min(life, nearest_thicknesses * (part[a].thickness + part[b].thickness) / rate);
    }
  constexpr double longest = 1.0;  // [s]
  expires_ = time_ + std::max(least, std::min(life, longest));
}

// [m/s] by which two parts' motions differ.
double Detection::rate_apart(std::size_t a, std::size_t b) const {
  return (part_velocity_[a] - part_velocity_[b]).norm();
}

// Tasks and what they find are in an order that the trees fix, whichever thread takes which.
void Detection::find_pairs(const Points& x) {
  struct Work {
    BoxTree::Task task;
    double gap;
  };
  std::vector<Work> work;
  std::vector<BoxTree::Task> tasks;
  const auto& part = surface_.part;
  for (std::size_t a = 0; a < part.size(); ++a)
    for (std::size_t b = a; b < part.size(); ++b) {
      if (a == b ? !part[a].self : !part[a].is_body() && !part[b].is_body()) continue;
      const double gap = rate_apart(a, b) * (expires_ - time_);
      tasks.clear();
      BoxTree::split(tree_[a], tree_[b], gap, tasks);
      for (const BoxTree::Task& task : tasks) work.push_back({task, gap});
    }
  std::vector<std::vector<ContactPair>> found(work.size());
  oneapi::tbb::this_task_arena::isolate([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, work.size(), [&](std::size_t k) {
      std::vector<FacePair> faces;
      BoxTree::pairs(work[k].task, work[k].gap, faces);
      for (const FacePair& pair : faces) narrow(x, pair, work[k].gap, found[k]);
    });
  });
  pair_.clear();
  for (const auto& some : found) pair_.insert(pair_.end(), some.begin(), some.end());
}

void Detection::narrow(const Points& x, const FacePair& faces, double gap, std::vector<ContactPair>& out) const {
  const FaceShare &a = surface_.share[faces.first], &b = surface_.share[faces.second];
  for (int k = 0; k < a.vertices; ++k) add_point_face(x, a.vertex[k], faces.second, gap, out);
  for (int k = 0; k < b.vertices; ++k) add_point_face(x, b.vertex[k], faces.first, gap, out);
  for (int k = 0; k < a.edges; ++k)
    for (int l = 0; l < b.edges; ++l) add_edge_edge(x, a.edge[k], b.edge[l], gap, out);
}

void Detection::add_point_face(const Points& x, int v, int f, double gap, std::vector<ContactPair>& out) const {
  const std::array<int, 3>& face = surface_.face[f];
  if (has(face, v) || surface_.part[surface_.part_of[face[0]]].rounded()) return;
  const Eigen::Vector3d &p = x[v], &a = x[face[0]], &b = x[face[1]], &c = x[face[2]];
  const double near = reach_[v] + std::max({reach_[face[0]], reach_[face[1]], reach_[face[2]]}) + gap;
  for (int axis = 0; axis < 3; ++axis)
    if (p(axis) + near < std::min({a(axis), b(axis), c(axis)}) ||
        p(axis) - near > std::max({a(axis), b(axis), c(axis)}))
      return;
  const Eigen::Vector3d weight = nearest_in_triangle(p, a, b, c);
  const Eigen::Vector3d difference = p - weight(0) * a - weight(1) * b - weight(2) * c;
  if (difference.squaredNorm() >= near * near) return;
  ContactPair pair{.vertex = {v, face[0], face[1], face[2]},
                   .weight = {1.0, -weight(0), -weight(1), -weight(2)},
                   .on_a = 1,
                   .acts = owns(f, face, weight, v)};
  const double distance = difference.norm();
  pair.normal = distance > 0.0 ? Eigen::Vector3d(difference / distance) : (b - a).cross(c - a).normalized();
  if (finish(x, distance, pair)) out.push_back(pair);
}

// Whether `face` answers for the nearest point of v on it: its inside always, an edge or a corner where they are its
// share, and between two vertices one of the two looks.
bool Detection::owns(int face, const std::array<int, 3>& corner, const Eigen::Vector3d& weight, int v) const {
  const FaceShare& share = surface_.share[face];
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
bool Detection::acts(int e, int f, const Eigen::Vector2d& at) const {
  const auto answers = [&](int edge, double share) {
    return (share > 0.0 && share < 1.0) || surface_.first_edge[surface_.edge[edge][share > 0.0]] == edge;
  };
  const auto rounded = [&](int edge) { return surface_.part[surface_.part_of[surface_.edge[edge][0]]].rounded(); };
  const bool inner_e = at(0) > 0.0 && at(0)<1.0, inner_f = at(1)> 0.0 && at(1) < 1.0;
  if (rounded(e)) return inner_e && answers(f, at(1));
  if (rounded(f)) return inner_f && answers(e, at(0));
  return inner_e && inner_f;
}

void Detection::add_edge_edge(const Points& x, int e, int f, double gap, std::vector<ContactPair>& out) const {
  const std::array<int, 2>&i = surface_.edge[e], &j = surface_.edge[f];
  if (i[0] == j[0] || i[0] == j[1] || i[1] == j[0] || i[1] == j[1]) return;
  const Eigen::Vector3d &a = x[i[0]], &b = x[i[1]], &c = x[j[0]], &d = x[j[1]];
  const double near = std::max(reach_[i[0]], reach_[i[1]]) + std::max(reach_[j[0]], reach_[j[1]]) + gap;
  for (int axis = 0; axis < 3; ++axis)
    if (std::max(a(axis), b(axis)) + near < std::min(c(axis), d(axis)) ||
        std::min(a(axis), b(axis)) - near > std::max(c(axis), d(axis)))
      return;
  const Eigen::Vector2d at = nearest_on_segments(a, b, c, d);
  const Eigen::Vector3d difference = (1.0 - at(0)) * a + at(0) * b - (1.0 - at(1)) * c - at(1) * d;
  if (difference.squaredNorm() >= near * near) return;
  ContactPair pair{.vertex = {i[0], i[1], j[0], j[1]},
                   .weight = {1.0 - at(0), at(0), at(1) - 1.0, -at(1)},
                   .on_a = 2,
                   .acts = acts(e, f, at)};
  const double distance = difference.norm();
  pair.normal = distance > 0.0 ? Eigen::Vector3d(difference / distance) : (b - a).cross(d - c).normalized();
  if (finish(x, distance, pair)) out.push_back(pair);
}

double Detection::rest_distance(const ContactPair& pair) const {
  const Points& rest = surface_.rest;
  const auto& v = pair.vertex;
  if (pair.on_a == 1) {
    const Eigen::Vector3d w = nearest_in_triangle(rest[v[0]], rest[v[1]], rest[v[2]], rest[v[3]]);
    return (rest[v[0]] - w(0) * rest[v[1]] - w(1) * rest[v[2]] - w(2) * rest[v[3]]).norm();
  }
  const Eigen::Vector2d at = nearest_on_segments(rest[v[0]], rest[v[1]], rest[v[2]], rest[v[3]]);
  return ((1.0 - at(0)) * rest[v[0]] + at(0) * rest[v[1]] - (1.0 - at(1)) * rest[v[2]] - at(1) * rest[v[3]]).norm();
}

// Thickness, friction and the plane.
bool Detection::finish(const Points& x, double distance, ContactPair& pair) const {
  const auto& v = pair.vertex;
  const SurfacePart &a = surface_.part[surface_.part_of[v[0]]], &b = surface_.part[surface_.part_of[v[pair.on_a]]];
  pair.thickness = a.thickness + b.thickness;
  if (&a == &b) {
    const double wide = pair.thickness;
    if (distance < wide || wide > farthest_edges * a.edge_length)
      pair.thickness = std::min(wide, rest_share * rest_distance(pair));
  }
  pair.radius = a.radius + b.radius;
  pair.friction = std::sqrt(a.friction * b.friction);
  put_plane(x, pair);
  return true;
}

// Between the corners as they are, so that it is right however roughly the nearest points were found, and moving as
// these do. Where one side cannot be held up, it gets little of the room, and the plane moves as it does.
void Detection::put_plane(const Points& x, ContactPair& pair) const {
  double low = INFINITY, high = -INFINITY, speed_a = 0.0, speed_b = 0.0;
  bool a_moves = false, b_moves = false;
  for (int k = 0; k < 4; ++k) {
    const int v = pair.vertex[k];
    const double height = pair.normal.dot(x[v]), speed = pair.weight[k] * pair.normal.dot(v_[v]);
    const bool free = surface_.inverse_mass[v] > 0.0;
    if (k < pair.on_a)
      low = std::min(low, height), a_moves = a_moves || free, speed_a += speed;
    else
      high = std::max(high, height), b_moves = b_moves || free, speed_b -= speed;
  }
  const double between = std::max(0.0, low - high - pair.radius - least_share * pair.thickness);
  const double share_a = a_moves == b_moves ? 0.5 : a_moves ? 0.9 : 0.1;
  pair.slack_a = share_a * between;
  pair.slack_b = between - pair.slack_a;
  pair.bound_a = low - pair.slack_a;
  pair.bound_b = high + pair.slack_b;
  pair.drift = a_moves == b_moves ? 0.5 * (speed_a + speed_b) : a_moves ? speed_b : speed_a;
  const auto mean_speed = [&](int v) { return pair.normal.dot(part_velocity_[surface_.part_of[v]]); };
  pair.loss_a = std::abs(mean_speed(pair.vertex[0]) - pair.drift);
  pair.loss_b = std::abs(mean_speed(pair.vertex[3]) - pair.drift);
}

bool Detection::holds(const Points& y, double time) {
  if (!valid_ || time > expires_) return false;
  const double t = time - time_;
  for (const SurfacePart& part : surface_.part) {
    const Eigen::Vector3d moved = t * part_velocity_[&part - surface_.part.data()];
    for (int i = part.first_vertex; i < part.first_vertex + part.vertices; ++i) {
      const double square = (y[i] - x_[i] - moved).squaredNorm();
      if (!(square <= room_[i] * room_[i])) return false;
      stray_[i] = static_cast<float>(std::sqrt(square));
    }
  }
  for (std::size_t p = 0; p < pair_.size(); ++p) {
    const Room& room = pair_room_[p];
    float most[2] = {0.0f, 0.0f};
    for (int k = 0; k < 4; ++k) most[k >= room.on_a] = std::max(most[k >= room.on_a], stray_[room.vertex[k]]);
    const auto passed = static_cast<float>(t);
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
void Detection::find_rooms() {
  constexpr double rounding = 1e-5;
  pair_room_.clear();
  for (const ContactPair& pair : pair_)
    pair_room_.push_back({.vertex = pair.vertex,
                          .on_a = pair.on_a,
                          .slack_a = static_cast<float>((1.0 - rounding) * pair.slack_a),
                          .slack_b = static_cast<float>((1.0 - rounding) * pair.slack_b),
                          .loss_a = static_cast<float>((1.0 + rounding) * pair.loss_a),
                          .loss_b = static_cast<float>((1.0 + rounding) * pair.loss_b)});
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
