// Bodies and colliders -> vertices, edges, triangles.
#include "sim/contact/contact_surface.h"

#include <algorithm>
#include <map>

#include "sim/mesh/split_quad.h"

namespace billow::sim {

namespace {

// As they are drawn.
void add_triangles(const Face& face, int first, const Points& rest, std::vector<std::array<int, 3>>& triangles) {
  const auto corner = [&](int k) { return first + face[k % 4]; };
  if (corner_count(face) == 3) {
    triangles.push_back({corner(0), corner(1), corner(2)});
    return;
  }
  const int s = split_corner(face, {rest[corner(0)], rest[corner(1)], rest[corner(2)], rest[corner(3)]});
  triangles.push_back({corner(s), corner(s + 1), corner(s + 2)});
  triangles.push_back({corner(s), corner(s + 2), corner(s + 3)});
}

// What of a collider is touched, as vertices and faces.
Mesh touched(const Collider& collider) {
  if (!collider.rounded) return collider.mesh;
  const Rounded& rounded = *collider.rounded;
  Mesh mesh;
  const bool ball = rounded.from == rounded.to;
  mesh.position.resize(ball ? 1 : 2, 3);
  mesh.position.row(0) = rounded.from;
  if (!ball) mesh.position.row(1) = rounded.to;
  mesh.face = {ball ? Face{0, 0, 0, -1} : Face{0, 1, 1, -1}};
  return mesh;
}

/// Fills a surface part by part.
class Builder {
 public:
  explicit Builder(ContactSurface& surface) : surface_(surface) {}

  void add(SurfacePart part, const std::vector<Face>& faces) {
    part.first_face = static_cast<int>(surface_.face.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
      add_triangles(faces[f], part.first_vertex, surface_.rest, surface_.face);
      surface_.polygon.resize(surface_.face.size(), static_cast<int>(f));
    }
    part.faces = static_cast<int>(surface_.face.size()) - part.first_face;
    const int number = static_cast<int>(surface_.part.size());
    for (int v = part.first_vertex; v < part.first_vertex + part.vertices; ++v) surface_.part_of[v] = number;
    share_out(part);
    surface_.part.push_back(std::move(part));
  }

 private:
  // Each vertex and each edge to the first triangle that has it.
  void share_out(SurfacePart& part) {
    std::vector<bool> taken(surface_.rest.size(), false);
    std::map<std::array<int, 2>, int> edges;
    double sum = 0.0;
    for (int f = part.first_face; f < part.first_face + part.faces; ++f) {
      const std::array<int, 3> face = surface_.face[f];
      FaceShare share;
      for (int k = 0; k < 3; ++k) {
        const int v = face[k], next = face[(k + 1) % 3];
        if (!taken[v]) share.vertex[share.vertices++] = v;
        taken[v] = true;
        const std::array<int, 2> edge{std::min(v, next), std::max(v, next)};
        if (v == next || !edges.try_emplace(edge, 0).second) continue;
        share.edge[share.edges++] = static_cast<int>(surface_.edge.size());
        for (const int end : edge)
          if (surface_.first_edge[end] < 0) surface_.first_edge[end] = static_cast<int>(surface_.edge.size());
        surface_.edge.push_back(edge);
        sum += (surface_.rest[edge[1]] - surface_.rest[edge[0]]).norm();
      }
      surface_.share.push_back(share);
    }
    part.edge_length = edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
  }

  ContactSurface& surface_;
};

}  // namespace

ContactSurface::ContactSurface(const Structure& structure, const ContactOptions& options)
    : particles(structure.particles()) {
  for (int i = 0; i < particles; ++i) {
    rest.emplace_back(structure.rest_position.row(i));
    inverse_mass.push_back(structure.inverse_mass(i));
  }
  std::vector<Mesh> mesh;
  for (const Collider& collider : options.collider) {
    mesh.push_back(collider.half_space ? Mesh{} : touched(collider));
    for (int v = 0; v < mesh.back().vertices(); ++v) {
      rest.emplace_back(mesh.back().position.row(v));
      inverse_mass.push_back(0.0);
    }
  }
  part_of.assign(rest.size(), -1);
  first_edge.assign(rest.size(), -1);
  Builder builder(*this);
  for (std::size_t b = 0; b < structure.body.size(); ++b) {
    const Body& body = structure.body[b];
    const BodyContact& contact = options.body[b];
    if (!contact.touches) continue;
    builder.add({.name = body.name,
                 .body = static_cast<int>(b),
                 .first_vertex = body.first_particle,
                 .vertices = body.particles,
                 .self = contact.self,
                 .thickness = 0.5 * contact.thickness,
                 .friction = contact.friction},
                contact.face);
  }
  int first = particles;
  for (std::size_t c = 0; c < options.collider.size(); ++c) {
    const Collider& collider = options.collider[c];
    if (collider.half_space) {
      half_space.push_back(static_cast<int>(c));
      continue;
    }
    builder.add({.name = collider.name,
                 .collider = static_cast<int>(c),
                 .first_vertex = first,
                 .vertices = mesh[c].vertices(),
                 .thickness = collider.thickness,
                 .radius = collider.rounded ? collider.rounded->radius : 0.0,
                 .friction = collider.friction},
                mesh[c].face);
    first += mesh[c].vertices();
  }
}

}  // namespace billow::sim
