// Detection, impulses and cells within a step.
#include "sim/contact/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/contact/start_check.h"

namespace billow::sim {

namespace {

// For so many steps a detection looks ahead at first, and at least and at most.
constexpr double first_ahead = 4.0, least_ahead = 2.0, most_ahead = 32.0;
// Of impulses, by attempt: with what was known, after a look of its own, and again.
constexpr int sweeps[] = {5, 5, 20, 40};
constexpr int last_attempt = 3;
// Shares into which one step may fall before what is in the way counts as crushed.
constexpr int most_shares = 200;

void gather(const Eigen::MatrixX3d& rows, Points& points) {
  for (Eigen::Index i = 0; i < rows.rows(); ++i) points[i] = rows.row(i);
}

void scatter(const Points& points, Eigen::MatrixX3d& rows) {
  for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = points[i];
}

}  // namespace

ContactModel::ContactModel(const Structure& structure, const ContactOptions& options)
    : options_(options), surface_(structure, options) {}

void ContactModel::place_colliders(double time, Points& x) const {
  for (const SurfacePart& part : surface_.part) {
    if (part.is_body()) continue;
    const Eigen::Isometry3d place = options_.collider[part.collider].motion.at(time);
    const Eigen::Matrix3d turn = place.linear();
    const Eigen::Vector3d shift = place.translation();
    for (int v = part.first_vertex; v < part.first_vertex + part.vertices; ++v) x[v] = turn * surface_.rest[v] + shift;
  }
}

Contact::Contact(const ContactModel& model)
    : model_(model),
      surface_(model.surface()),
      detection_(model.surface()),
      impulses_(model.surface()),
      share_impulses_(model.surface()) {
  from_ = to_ = start_ = surface_.rest;
  velocity_.assign(from_.size(), Eigen::Vector3d::Zero());
  way_ = velocity_;
}

void Contact::begin(State& state, double h) {
  time_ = state.time, h_ = h;
  gather(state.position, from_);
  model_.place_colliders(time_, from_);
  model_.place_colliders(time_ + h, to_);
  for (int v = surface_.particles; v < surface_.vertices(); ++v) velocity_[v] = (to_[v] - from_[v]) / h;
  find_spins();
  place_planes();
}

void Contact::find_spins() {
  spin_.assign(surface_.part.size(), Eigen::Vector3d::Zero());
  for (std::size_t p = 0; p < spin_.size(); ++p) {
    if (!surface_.part[p].rounded()) continue;
    const KeyedMotion& motion = model_.options().collider[surface_.part[p].collider].motion;
    const Eigen::AngleAxisd turn(motion.at(time_ + h_).linear() * motion.at(time_).linear().transpose());
    spin_[p] = turn.angle() / h_ * turn.axis();
  }
}

// For twice as long ahead as before where that was all used up and for as long as it lasted where not.
void Contact::detect() {
  if (!detection_.valid()) {
    ahead_ = first_ahead;
  } else {
    const double lasted = std::round((time_ - detection_.time()) / h_);
    ahead_ = time_ + h_ > detection_.expires() ? 2.0 * ahead_ : lasted;
    ahead_ = std::clamp(ahead_, least_ahead, most_ahead);
  }
  detection_.detect(from_, velocity_, time_, h_, ahead_);
  impulses_.remember(detection_.pairs());
}

void Contact::place_planes() {
  plane_.clear();
  for (const int c : surface_.half_space) {
    const Collider& collider = model_.options().collider[c];
    const Eigen::Isometry3d now = collider.motion.at(time_), next = collider.motion.at(time_ + h_);
    plane_.push_back({.name = collider.name,
                      .point = now * collider.half_space->point,
                      .normal = now.linear() * collider.half_space->normal,
                      .next_point = next * collider.half_space->point,
                      .next_normal = next.linear() * collider.half_space->normal,
                      .turn = next * now.inverse(),
                      .thickness = collider.thickness,
                      .friction = collider.friction,
                      .moves = collider.motion.moves()});
  }
}

// [m] over the plane after that share of the step.
double Contact::height_over(const Plane& plane, const Eigen::Vector3d& x, double share) const {
  if (!plane.moves) return plane.normal.dot(x - plane.point);
  const Eigen::Vector3d point = plane.point + share * (plane.next_point - plane.point);
  return (plane.normal + share * (plane.next_normal - plane.normal)).normalized().dot(x - point);
}

void Contact::find_plane_contacts(const Points& x) {
  plane_contact_.clear();
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  for (int p = 0; p < static_cast<int>(plane_.size()); ++p)
    for (const SurfacePart& part : surface_.part) {
      if (!part.is_body()) continue;
      const Plane& plane = plane_[p];
      const double thickness = part.thickness + plane.thickness;
      for (int v = part.first_vertex; v < part.first_vertex + part.vertices; ++v) {
        if (surface_.inverse_mass[v] == 0.0) continue;
        const double gap = plane.normal.dot(x[v] - plane.point) - thickness;
        const Eigen::Vector3d solid = plane.moves ? Eigen::Vector3d((plane.turn * x[v] - x[v]) / h_) : none;
        if (gap + h_ * plane.normal.dot(velocity_[v] - solid) > thickness) continue;
        plane_contact_.push_back({p, v, plane.normal, solid, gap, std::sqrt(part.friction * plane.friction)});
      }
    }
}

// Impulses by what was near when the surface was last looked at; further looks where that is used up, each from the
// velocities that a blow has left by then, and more sweeps.
void Contact::apply(const State& state, const Move& move, Eigen::MatrixX3d& velocity) {
  gather(velocity, velocity_);
  gather(state.position, to_);
  if (!detection_.valid()) detect();
  find_plane_contacts(to_);
  std::copy(to_.begin(), to_.begin() + surface_.particles, start_.begin());
  std::copy(from_.begin() + surface_.particles, from_.end(), start_.begin() + surface_.particles);
  work_ = 0.0;
  bool first = true;
  for (int attempt = 0;; ++attempt, first = false) {
    impulses_.apply(detection_.pairs(), plane_contact_, spin_, start_, h_, {first, sweeps[attempt]}, velocity_);
    work_ += impulses_.work();
    arrive(state, move);
    held_ = holds();
    if (held_ || attempt == last_attempt) break;
    if (detection_.time() != time_ || !detection_.has_room(to_, time_ + h_)) detect();
  }
  scatter(velocity_, velocity);
}

// Where the step will end, as far as it is known.
void Contact::arrive(const State& state, const Move& move) {
  for (int i = 0; i < surface_.particles; ++i) to_[i] = start_[i] + move.by_new * velocity_[i];
  if (move.by_old != 0.0)
    for (int i = 0; i < surface_.particles; ++i) to_[i] += move.by_old * state.velocity.row(i).transpose();
  if (impulses_.pushes())
    for (int i = 0; i < surface_.particles; ++i) to_[i] += impulses_.push()[i];
}

bool Contact::holds() {
  for (const Plane& plane : plane_)
    for (const SurfacePart& part : surface_.part)
      for (int v = part.first_vertex; v < part.first_vertex + part.vertices && part.is_body(); ++v) {
        const double least = least_share * (part.thickness + plane.thickness);
        if (height_over(plane, to_[v], 1.0) < std::min(least, height_over(plane, from_[v], 0.0))) return false;
      }
  return detection_.holds(to_, time_ + h_);
}

void Contact::end(State& state) {
  straight_ = held_;
  if (!held_) go_in_shares(state);
  if (!held_ || impulses_.pushes()) scatter(to_, state.position);
}

// Where a vertex would end within a half-space, its way leads along that. What is pinned cannot.
void Contact::keep_above_planes(const Points& x, double from, Points& way) const {
  for (const Plane& plane : plane_)
    for (const SurfacePart& part : surface_.part)
      for (int v = part.first_vertex; v < part.first_vertex + part.vertices && part.is_body(); ++v) {
        if (surface_.inverse_mass[v] == 0.0) {
          if (height_over(plane, to_[v], 1.0) < 0.0) blocked(part.name, plane.name);
          continue;
        }
        const double least = least_share * (part.thickness + plane.thickness);
        const double floor = std::min(least, height_over(plane, x[v], from));
        const double height = height_over(plane, x[v] + way[v], 1.0);
        if (height < floor) way[v] += (floor - height) * plane.next_normal;
      }
}

// Whether a vertex that goes `share` of its way is over all planes when these have gone as far.
bool Contact::is_above_planes(int v, const Eigen::Vector3d& x, double share) const {
  const SurfacePart& part = surface_.part[surface_.part_of[v]];
  return std::all_of(plane_.begin(), plane_.end(), [&](const Plane& plane) {
    const double least = least_share * (part.thickness + plane.thickness);
    return !plane.moves || height_over(plane, x, share) >= std::min(0.5 * least, height_over(plane, from_[v], 0.0));
  });
}

// Each share begins with a look of its own; its cells stand still. Whoever a collider meets is pushed on as by an
// impulse. What a vertex could not go it stays behind, and is no faster than it came: a motion that does not take place
// must not go on pulling at springs. What is not moved by contact arrives.
void Contact::go_in_shares(State& state) {
  ++shared_steps_;
  Points x = from_;
  for (std::size_t i = 0; i < x.size(); ++i) way_[i] = to_[i] - x[i];
  stopped_.assign(x.size(), false);
  double done = 0.0;
  for (int round = 0; done < 1.0; ++round) {
    detection_.detect_standing(x, way_, time_);
    keep_above_planes(x, done, way_);
    if (round > 0) {
      share_impulses_.remember(detection_.pairs());
      share_impulses_.apply(detection_.pairs(), {}, spin_, x, 1.0, {.first = false}, way_);
      keep_above_planes(x, done, way_);
    }
    double share = detection_.shares(way_, share_);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (surface_.inverse_mass[i] == 0.0 && surface_.part_of[i] >= 0) share = std::min(share, share_[i]);
    for (int i = 0; i < surface_.particles; ++i)
      if (share_[i] < share && surface_.part_of[i] >= 0 &&
          !is_above_planes(i, x[i] + share_[i] * way_[i], done + share * (1.0 - done)))
        share = share_[i];
    if (round >= most_shares) crushed();
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (share_[i] < share) stopped_[i] = true;
      x[i] += std::min(share, share_[i]) * way_[i];
      way_[i] *= 1.0 - share;
    }
    done = share == 1.0 ? 1.0 : done + share * (1.0 - done);
    constexpr double arrived = 1.0 - 1e-9;
    if (done > arrived) done = 1.0;
  }
  for (int i = 0; i < surface_.particles; ++i) {
    if (surface_.inverse_mass[i] == 0.0) continue;
    to_[i] = x[i];
    const Eigen::RowVector3d come = (x[i] - from_[i]) / h_;
    if (stopped_[i] && come.squaredNorm() < state.velocity.row(i).squaredNorm()) state.velocity.row(i) = come;
  }
  detection_.expire();
}

// Names the body and what presses it: the pair that keeps something unstoppable back the most.
void Contact::crushed() const {
  const ContactPair* worst = nullptr;
  double least = 2.0;
  for (const ContactPair& pair : detection_.pairs())
    for (const int v : pair.vertex)
      if (surface_.inverse_mass[v] == 0.0 && share_[v] < least) least = share_[v], worst = &pair;
  const auto& name = [&](int v) -> const std::string& { return surface_.part[surface_.part_of[v]].name; };
  if (worst) blocked(name(worst->vertex[0]), name(worst->vertex[worst->on_a]));
  // Else a half-space that moves: it waits for a vertex.
  const auto waits = std::min_element(share_.begin(), share_.begin() + surface_.particles);
  const auto moving = std::find_if(plane_.begin(), plane_.end(), [](const Plane& plane) { return plane.moves; });
  blocked(name(static_cast<int>(waits - share_.begin())), moving == plane_.end() ? "something" : moving->name);
}

void Contact::blocked(const std::string& one, const std::string& other) const {
  throw BlockedError(fmt::format(
      "at t = {:.4f} s '{}' is pressed against '{}' and has nowhere to go; move the colliders or pins less far or "
      "slower, or make the bodies thinner",
      time_, one, other));
}

namespace {

void check_above(const ContactModel& model, const SurfacePart& part, int half_space, double time, const Points& x) {
  const Collider& collider = model.options().collider[half_space];
  const Eigen::Isometry3d place = collider.motion.at(time);
  const Eigen::Vector3d point = place * collider.half_space->point,
                        normal = place.linear() * collider.half_space->normal;
  int below = 0, lowest = part.first_vertex;
  for (int v = part.first_vertex; v < part.first_vertex + part.vertices; ++v) {
    below += normal.dot(x[v] - point) < 0.0;
    if (normal.dot(x[v] - x[lowest]) < 0.0) lowest = v;
  }
  if (below == 0) return;
  throw StartError(fmt::format("{} of the {} vertices of '{}' start inside '{}', vertex {} the deepest, by {:.3g} m; "
                               "move them apart, or say 'contact: none'",
                               below, part.vertices, part.name, collider.name, lowest - part.first_vertex,
                               normal.dot(point - x[lowest])),
                   part.body);
}

}  // namespace

void check_start(const ContactModel& model, const State& start) {
  const ContactSurface& surface = model.surface();
  Points x = surface.rest;
  gather(start.position, x);
  model.place_colliders(start.time, x);
  for (const int h : surface.half_space)
    for (const SurfacePart& part : surface.part)
      if (part.is_body()) check_above(model, part, h, start.time, x);
  check_apart(surface, x);
}

}  // namespace billow::sim
