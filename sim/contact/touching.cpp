// One look at the surface, as if nothing moved.
#include "sim/contact/touching.h"

#include <algorithm>

#include "sim/contact/closest_points.h"
#include "sim/contact/detection.h"

namespace billow::sim {
namespace {

// [thicknesses] what a detection of standing vertices finds is no farther.
constexpr double reach = 1.5;

// Of the distance at which parts of one cloth rest: nearer than that they have been brought together.
constexpr double brought_together = 0.8;

// [m] Where a thick cloth's neighbours rest nearer than its thickness they keep a little less than that, and touch only
// when they are pressed together; neighbours somewhat farther than that are no nearer than they rest.
double reach_of(const ContactPair& pair, const ContactSurface& surface) {
  const auto part = [&](int k) -> const SurfacePart& { return surface.part[surface.part_of[pair.vertex[k]]]; };
  const bool as_they_rest = pair.thickness < part(0).thickness + part(pair.on_a).thickness;
  if (as_they_rest) return pair.radius + pair.thickness;
  const double far = pair.radius + reach * pair.thickness;
  if (&part(0) != &part(pair.on_a)) return far;
  return std::min(far, brought_together * nearest_points(pair.vertex, pair.on_a, surface.rest).difference.norm());
}

void add_pairs(const Detection& detection, const ContactSurface& surface, const Points& x, Eigen::VectorXd& touches) {
  for (const ContactPair& pair : detection.pairs()) {
    if (nearest_points(pair.vertex, pair.on_a, x).difference.norm() > reach_of(pair, surface)) continue;
    for (int k = 0; k < 4; ++k)
      if (pair.weight[k] != 0.0 && pair.vertex[k] < touches.size()) touches(pair.vertex[k]) = 1.0;
  }
}

void add_half_space(const Collider& collider, const SurfacePart& part, const State& state, Eigen::VectorXd& touches) {
  const Eigen::Isometry3d place = collider.motion.at(state.time);
  const Eigen::Vector3d point = place * collider.half_space->point;
  const Eigen::Vector3d normal = place.linear() * collider.half_space->normal;
  for (int v = part.first_vertex; v < part.first_vertex + part.vertices; ++v) {
    const double height = normal.dot(state.position.row(v).transpose() - point);
    if (height <= reach * (part.thickness + collider.thickness)) touches(v) = 1.0;
  }
}

}  // namespace

Eigen::VectorXd touching(const ContactModel& model, const State& state) {
  const ContactSurface& surface = model.surface();
  Points x = surface.rest;
  for (int i = 0; i < surface.particles; ++i) x[i] = state.position.row(i);
  model.place_colliders(state.time, x);
  Detection detection(surface);
  detection.detect_standing(x, Points(x.size(), Eigen::Vector3d::Zero()), state.time);
  Eigen::VectorXd touches = Eigen::VectorXd::Zero(state.position.rows());
  add_pairs(detection, surface, x, touches);
  for (const int c : surface.half_space)
    for (const SurfacePart& part : surface.part)
      if (part.is_body()) add_half_space(model.options().collider[c], part, state, touches);
  return touches;
}

}  // namespace billow::sim
