// Boxes -> features.
#include "sim/contact/neighbourhood.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/parallel.h"
#include "sim/contact/closest_points.h"

namespace billow::sim {

namespace {

// Of the shortest mean edge of a body: searching farther finds a cloth's own neighbours everywhere.
constexpr double room_edges = 0.1;
// Of the thickness: room for every vertex at least.
constexpr double room_thicknesses = 1.0;
// Of all triangles: where more have changed, all are searched.
constexpr double most_changed = 0.2;
// A search is for so many looks, at first and at the most.
constexpr double first_looks = 4.0, most_looks = 32.0;

// The least vertex that both have; -1: none.
int first_shared(const std::array<int, 3>& f, const std::array<int, 3>& g) {
  int first = -1;
  for (const int v : f)
    if ((v == g[0] || v == g[1] || v == g[2]) && (first < 0 || v < first)) first = v;
  return first;
}

}  // namespace

Neighbourhood::Neighbourhood(const ContactSurface& surface)
    : surface_(surface),
      reach_(surface.rest.size()),
      then_(surface.rest.size()),
      face_velocity_(surface.face.size()),
      face_spread_(surface.face.size()) {
  double edge = INFINITY;
  for (const SurfacePart& part : surface.part) {
    tree_.emplace_back(surface, part);
    if (part.is_body() && part.faces > 0) edge = std::min(edge, part.edge_length);
  }
  if (!std::isinf(edge)) edge_room_ = room_edges * edge;
  for (const SurfacePart& part : surface.part)
    for (int i = part.first_vertex; i < part.first_vertex + part.vertices; ++i)
      reach_[i] = part.radius + part.thickness + room(part);
  faces_of_.resize(surface.rest.size());
  changed_.assign(surface.face.size(), 0);
  answers_[0].assign(surface.rest.size(), -1), answers_[1].assign(surface.edge.size(), -1);
  for (int f = 0; f < static_cast<int>(surface.face.size()); ++f) {
    for (const int v : surface.face[f])
      if (faces_of_[v].empty() || faces_of_[v].back() != f) faces_of_[v].push_back(f);
    const FaceShare& share = surface.share[f];
    for (int k = 0; k < share.vertices; ++k) answers_[0][share.vertex[k]] = f;
    for (int k = 0; k < share.edges; ++k) answers_[1][share.edge[k]] = f;
  }
  find_rings();
}

// Of bodies that touch themselves.
void Neighbourhood::find_rings() {
  ring_.first_pair = ring_.first_neighbour = {0};
  for (int w = 0; w < surface_.vertices(); ++w) {
    std::set<int> corners;
    const std::vector<int> none;
    const bool self = surface_.part_of[w] >= 0 && surface_.part[surface_.part_of[w]].self;
    const std::vector<int>& faces = self ? faces_of_[w] : none;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const auto& face = surface_.face[faces[k]];
      corners.insert(face.begin(), face.end());
      for (std::size_t l = k + 1; l < faces.size(); ++l)
        if (first_shared(face, surface_.face[faces[l]]) == w) ring_.pair.emplace_back(faces[k], faces[l]);
    }
    corners.erase(w);
    ring_.neighbour.insert(ring_.neighbour.end(), corners.begin(), corners.end());
    ring_.first_pair.push_back(static_cast<int>(ring_.pair.size()));
    ring_.first_neighbour.push_back(static_cast<int>(ring_.neighbour.size()));
  }
  ring_.spoke.resize(ring_.neighbour.size());
  ring_.apart.assign(surface_.rest.size(), 0.0);
}

double Neighbourhood::room(const SurfacePart& part) const {
  return std::max(room_thicknesses * part.thickness, edge_room_);
}

bool Neighbourhood::cover(const Points& x, const Points& v, const std::vector<double>& margin, const Span& span) {
  if (valid_ && span.last <= time_ + ahead_) {
    find_strays(x, v, margin, span);
    if (stray_.empty() || follow_strays(x, v, span.time)) return false;
  }
  v_ = v;
  for_each_range(static_cast<int>(surface_.face.size()), 1, least_part_of_a_pass, [&](int, int begin, int end) {
    for (int f = begin; f < end; ++f) set_face_motion(f);
  });
  choose_ahead(span.time, span.last - span.time);
  search(x, v, span.time);
  return true;
}

// All that have used up half of their room, if one has used up its own.
void Neighbourhood::find_strays(const Points& x, const Points& v, const std::vector<double>& margin, const Span& span) {
  const double now = span.time - time_, step = span.next - span.time;
  stray_.clear();
  bool left = false;
  for (const SurfacePart& part : surface_.part)
    for (int i = part.first_vertex; i < part.first_vertex + part.vertices; ++i) {
      const double room = std::max(0.0, this->room(part) - margin[i]);
      const Eigen::Vector3d off = x[i] - x_[i] - now * v_[i];
      const double square = std::max(off.squaredNorm(), (off + step * (v[i] - v_[i])).squaredNorm());
      if (square <= 0.25 * room * room) continue;
      left = left || !(square <= room * room);
      stray_.push_back(i);
    }
  if (!left) stray_.clear();
}

// They get a new motion, as though they had been in it since the search, and what is near the triangles around them is
// found anew. Gives up where these are too many.
bool Neighbourhood::follow_strays(const Points& x, const Points& v, double time) {
  std::vector<int> faces;
  for (const int i : stray_)
    for (const int f : faces_of_[i])
      if (!changed_[f]) changed_[f] = 1, faces.push_back(f);
  const bool few = most_changed * static_cast<double>(surface_.face.size()) > static_cast<double>(faces.size());
  if (few) {
    for (const int i : stray_) {
      v_[i] = v[i];
      x_[i] = x[i] - (time - time_) * v[i];
      then_[i] = x_[i] + ahead_ * v[i];
    }
    std::sort(faces.begin(), faces.end());
    search_around(faces);
  }
  for (const int f : faces) changed_[f] = 0;
  return few;
}

void Neighbourhood::search_around(const std::vector<int>& faces) {
  for (const int f : faces) set_face_motion(f);
  const auto part_of = [&](int f) { return surface_.part_of[surface_.face[f][0]]; };
  for (auto begin = faces.begin(); begin != faces.end();) {
    const int p = part_of(*begin);
    const auto end = std::find_if(begin, faces.end(), [&](int f) { return part_of(f) != p; });
    tree_[p].refit_some({begin, end}, x_, then_, reach_);
    begin = end;
  }
  std::erase_if(features_, [&](const Features& features) {
    return changed_[answers_[features.on_a - 1][features.first]] ||
           changed_[features.on_a == 1 ? features.second : answers_[1][features.second]];
  });
  std::vector<std::vector<Features>> found(faces.size());
  oneapi::tbb::this_task_arena::isolate([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t k) { search_around(faces[k], found[k]); });
  });
  for (const auto& some : found) features_.insert(features_.end(), some.begin(), some.end());
  std::vector<int> centre;
  for (const int f : faces)
    if (surface_.part[part_of(f)].self) centre.insert(centre.end(), surface_.face[f].begin(), surface_.face[f].end());
  std::sort(centre.begin(), centre.end());
  centre.erase(std::unique(centre.begin(), centre.end()), centre.end());
  for (const int w : centre) search_ring(w, true, features_);
}

// Of two that have changed the lesser one finds both.
void Neighbourhood::search_around(int f, std::vector<Features>& found) const {
  const int p = surface_.part_of[surface_.face[f][0]];
  std::vector<int> near;
  for (int q = 0; q < static_cast<int>(tree_.size()); ++q) {
    if (!are_paired(p, q)) continue;
    near.clear();
    tree_[q].add_meeting(tree_[p], f, near);
    for (const int g : near) {
      if (changed_[g] && g <= f) continue;
      if (p == q && first_shared(surface_.face[f], surface_.face[g]) >= 0) continue;
      narrow({f, g}, found);
    }
  }
}

bool Neighbourhood::are_paired(int p, int q) const {
  const SurfacePart &a = surface_.part[p], &b = surface_.part[q];
  return p == q ? a.self : a.is_body() || b.is_body();
}

bool Neighbourhood::holds(const Points& y, double time) const {
  if (!valid_ || time > time_ + ahead_) return false;
  const double t = time - time_;
  for (const SurfacePart& part : surface_.part) {
    const double most = room(part);
    for (int i = part.first_vertex; i < part.first_vertex + part.vertices; ++i)
      if (!((y[i] - x_[i] - t * v_[i]).squaredNorm() <= most * most)) return false;
  }
  return true;
}

// Twice as long as the last time where that was used up, half as long where not.
void Neighbourhood::choose_ahead(double time, double ahead) {
  if (!valid_)
    ahead_ = first_looks * ahead;
  else if (time + ahead > time_ + ahead_)
    ahead_ *= 2.0;
  else
    ahead_ *= 0.5;
  const double spread =
      std::sqrt(std::inner_product(face_spread_.begin(), face_spread_.end(), face_spread_.begin(), 0.0) /
                static_cast<double>(face_spread_.size()));
  if (spread > 0.0) ahead_ = std::min(ahead_, edge_room_ / spread);
  ahead_ = std::clamp(ahead_, ahead, most_looks * ahead);
}

void Neighbourhood::search(const Points& x, const Points& v, double time) {
  x_ = x, v_ = v, time_ = time;
  for (std::size_t i = 0; i < x.size(); ++i) then_[i] = x[i] + ahead_ * v[i];
  for (BoxTree& tree : tree_) tree.refit(x_, then_, reach_);
  find_features();
  valid_ = true;
}

void Neighbourhood::set_face_motion(int f) {
  const std::array<int, 3>& face = surface_.face[f];
  face_velocity_[f] = (v_[face[0]] + v_[face[1]] + v_[face[2]]) / 3.0;
  double square = 0.0;
  for (const int v : face) square = std::max(square, (v_[v] - face_velocity_[f]).squaredNorm());
  face_spread_[f] = std::sqrt(square);
}

// Tasks and what they find are in an order that the trees fix, whichever thread takes which.
void Neighbourhood::find_features() {
  std::vector<BoxTree::Task> tasks;
  const int parts = static_cast<int>(tree_.size());
  for (int a = 0; a < parts; ++a)
    for (int b = a; b < parts; ++b)
      if (are_paired(a, b)) BoxTree::split(tree_[a], tree_[b], tasks);
  std::vector<std::vector<Features>> found(tasks.size());
  oneapi::tbb::this_task_arena::isolate([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t k) {
      std::vector<FacePair> faces;
      BoxTree::pairs(tasks[k], faces);
      for (const FacePair& pair : faces)
        if (first_shared(surface_.face[pair.first], surface_.face[pair.second]) < 0) narrow(pair, found[k]);
    });
  });
  features_.clear();
  std::vector<std::vector<Features>> around(most_parts());
  for_each_range(static_cast<int>(surface_.rest.size()), 1, least_part_of_a_pass, [&](int part, int begin, int end) {
    for (int w = begin; w < end; ++w) search_ring(w, false, around[part]);
  });
  for (const auto& some : around) features_.insert(features_.end(), some.begin(), some.end());
  for (const auto& some : found) features_.insert(features_.end(), some.begin(), some.end());
}

// What two triangles answer for, as long as it shares no vertex and is no inside of something rounded.
template <class Visit>
void Neighbourhood::for_each_features(const FacePair& faces, const Visit& visit) const {
  const auto visit_vertices = [&](const FaceShare& share, int f) {
    const std::array<int, 3>& face = surface_.face[f];
    if (surface_.part[surface_.part_of[face[0]]].rounded()) return;
    for (int k = 0; k < share.vertices; ++k) {
      const int v = share.vertex[k];
      if (v != face[0] && v != face[1] && v != face[2]) visit(point_face(v, f));
    }
  };
  const FaceShare &a = surface_.share[faces.first], &b = surface_.share[faces.second];
  visit_vertices(a, faces.second);
  visit_vertices(b, faces.first);
  for (int k = 0; k < a.edges; ++k)
    for (int l = 0; l < b.edges; ++l) {
      const std::array<int, 2>&i = surface_.edge[a.edge[k]], &j = surface_.edge[b.edge[l]];
      if (i[0] != j[0] && i[0] != j[1] && i[1] != j[0] && i[1] != j[1]) visit(edge_edge(a.edge[k], b.edge[l]));
    }
}

// Two features come nearer by no more than two of their corners' velocities differ. The lesser triangle's come first,
// whoever found the two.
void Neighbourhood::narrow(const FacePair& faces, std::vector<Features>& found) const {
  const auto [f, g] = std::minmax(faces.first, faces.second);
  const double approach = ahead_ * ((face_velocity_[f] - face_velocity_[g]).norm() + face_spread_[f] + face_spread_[g]);
  for_each_features({f, g}, [&](const Features& features) {
    if (may_meet(features, approach)) found.push_back(features);
  });
}

// Neighbours keep apart as long as the spokes between them hardly change, and are not looked at before.
void Neighbourhood::search_ring(int w, bool changed_only, std::vector<Features>& found) {
  const int first = ring_.first_pair[w], last = ring_.first_pair[w + 1];
  if (first == last) return;
  const double near = 2.0 * reach_[w] + 2.0 * ahead_ * ring_speed(w);
  if (near + 2.0 * ring_change(w) < ring_.apart[w]) return;
  ring_.apart[w] = ring_distance(w);
  for (int k = ring_.first_neighbour[w]; k < ring_.first_neighbour[w + 1]; ++k)
    ring_.spoke[k] = x_[ring_.neighbour[k]] - x_[w];
  if (near < ring_.apart[w]) return;
  for (int p = first; p < last; ++p)
    if (!changed_only || changed_[ring_.pair[p].first] || changed_[ring_.pair[p].second]) narrow(ring_.pair[p], found);
}

// [m] by which a spoke differs from what it was: no two corners of the ring are nearer by more than twice that.
double Neighbourhood::ring_change(int w) const {
  double square = 0.0;
  for (int k = ring_.first_neighbour[w]; k < ring_.first_neighbour[w + 1]; ++k)
    square = std::max(square, (x_[ring_.neighbour[k]] - x_[w] - ring_.spoke[k]).squaredNorm());
  return std::sqrt(square);
}

// [m/s] by which it changes.
double Neighbourhood::ring_speed(int w) const {
  double square = 0.0;
  for (int k = ring_.first_neighbour[w]; k < ring_.first_neighbour[w + 1]; ++k)
    square = std::max(square, (v_[ring_.neighbour[k]] - v_[w]).squaredNorm());
  return std::sqrt(square);
}

// [m] between any two features of its pairs that share no vertex.
double Neighbourhood::ring_distance(int w) const {
  double square = INFINITY;
  for (int p = ring_.first_pair[w]; p < ring_.first_pair[w + 1]; ++p)
    for_each_features(ring_.pair[p], [&](const Features& features) {
      square = std::min(square, nearest_points(features.vertex, features.on_a, x_).difference.squaredNorm());
    });
  return std::sqrt(square);
}

Features Neighbourhood::point_face(int v, int f) const {
  const std::array<int, 3>& face = surface_.face[f];
  return {1, v, f, {v, face[0], face[1], face[2]}};
}

Features Neighbourhood::edge_edge(int e, int f) const {
  const std::array<int, 2>&i = surface_.edge[e], &j = surface_.edge[f];
  return {2, e, f, {i[0], i[1], j[0], j[1]}};
}

bool Neighbourhood::may_meet(const Features& features, double approach) const {
  const auto& v = features.vertex;
  const double second = std::max(reach_[v[2]], reach_[v[3]]);
  const double near = features.on_a == 1 ? reach_[v[0]] + std::max(reach_[v[1]], second)
                                         : std::max(reach_[v[0]], reach_[v[1]]) + second;
  if (are_kept_apart(features, x_, then_, near)) return false;
  return nearest_points(features.vertex, features.on_a, x_).difference.squaredNorm() <
         (near + approach) * (near + approach);
}

bool are_kept_apart(const Features& features, const Points& now, const Points& then, double apart) {
  const auto& v = features.vertex;
  const bool edges = features.on_a == 2;
  // 1: the first one is ahead, -1: the second one, 0: neither.
  const auto order = [&](const Points& x, int axis) {
    const double a = x[v[0]](axis), b = x[v[1]](axis), c = x[v[2]](axis), d = x[v[3]](axis);
    const double low = std::min(c, d), high = std::max(c, d);
    const double first_low = edges ? std::min(a, b) : a, first_high = edges ? std::max(a, b) : a;
    const double second_low = edges ? low : std::min(b, low), second_high = edges ? high : std::max(b, high);
    return static_cast<int>(first_low - second_high >= apart) - static_cast<int>(second_low - first_high >= apart);
  };
  for (int axis = 0; axis < 3; ++axis)
    if (const int ahead = order(now, axis); ahead != 0 && order(then, axis) == ahead) return true;
  return false;
}

}  // namespace billow::sim
