// Surfaces -> triangles -> crossings.
#include "tests/support/surface_crossings.h"

namespace billow::test {

using namespace sim;

namespace {

TriangleSoup triangles_of(const ContactSurface& surface, const Points& x) {
  Eigen::MatrixX3d position(surface.vertices(), 3);
  for (int v = 0; v < surface.vertices(); ++v) position.row(v) = x[v];
  std::vector<Face> faces;
  for (const SurfacePart& part : surface.part)
    for (int f = part.first_face; f < part.first_face + part.faces && !part.rounded(); ++f)
      faces.push_back({surface.face[f][0], surface.face[f][1], surface.face[f][2], -1});
  TriangleSoup soup;
  soup.add(position, faces);
  return soup;
}

std::size_t below(const ContactModel& model, int half_space, const State& state) {
  const Collider& collider = model.options().collider[half_space];
  const Eigen::Isometry3d place = collider.motion.at(state.time);
  const Eigen::Vector3d point = place * collider.half_space->point,
                        normal = place.linear() * collider.half_space->normal;
  std::size_t count = 0;
  for (const SurfacePart& part : model.surface().part)
    for (int v = part.first_vertex; v < part.first_vertex + part.vertices && part.is_body(); ++v)
      count += normal.dot(state.position.row(v).transpose() - point) < 0.0;
  return count;
}

// Whether contact is to keep the two vertices' surfaces apart: what lies beyond the surface's own vertices is drawn of
// a collider.
bool touch(const ContactSurface& surface, int v, int w) {
  const auto part_of = [&](int i) { return i < surface.vertices() ? &surface.part[surface.part_of[i]] : nullptr; };
  const SurfacePart *a = part_of(v), *b = part_of(w);
  if (a == b) return a && a->self;
  return (a && a->is_body()) || (b && b->is_body());
}

std::size_t counted(const ContactSurface& surface, const TriangleSoup& soup) {
  std::size_t count = 0;
  for (const Crossing& crossing : crossings(soup))
    count += touch(surface, crossing.edge_a, soup.triangle(crossing.triangle, 0));
  return count;
}

}  // namespace

std::size_t crossings_of(const ContactSurface& surface, const Points& x) {
  return counted(surface, triangles_of(surface, x));
}

std::size_t crossings_of(const ContactModel& model, const State& state) {
  const ContactSurface& surface = model.surface();
  Points x = surface.rest;
  for (int i = 0; i < surface.particles; ++i) x[i] = state.position.row(i);
  model.place_colliders(state.time, x);
  TriangleSoup soup = triangles_of(surface, x);
  for (const Collider& collider : model.options().collider) {
    if (!collider.rounded) continue;
    const Eigen::Isometry3d place = collider.motion.at(state.time);
    soup.add((collider.mesh.position * place.linear().transpose()).rowwise() + place.translation().transpose(),
             collider.mesh.face);
  }
  std::size_t count = counted(surface, soup);
  for (const int h : surface.half_space) count += below(model, h, state);
  return count;
}

}  // namespace billow::test
