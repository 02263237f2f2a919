// Asking a body's kind.
#include "cli/scene/body_kind.h"

#include "cli/scene/scene.h"
#include "cli/scene/scene_parts.h"

namespace billow::cli {

Words<StripOrder> words(StripOrder) {
  static constexpr Word<StripOrder> list[] = {{"zigzag", StripOrder::zigzag}, {"mesh", StripOrder::mesh}};
  return list;
}

void place_mesh(const sim::Mesh& mesh, const BodyDraft& draft, BodySpec& body) {
  std::visit([&](auto& kind) { kind.place(mesh, draft, body); }, body.kind);
}

sim::Structure build_body(const BodySpec& body) {
  return std::visit([&](const auto& kind) { return kind.build(body); }, body.kind);
}

void add_laws(const Scene& scene, const sim::Structure& structure, int number, sim::Forces& forces) {
  std::visit([&](const auto& kind) { kind.add_laws(scene, structure, number, forces); },
             scene.bodies[static_cast<std::size_t>(number)].kind);
}

sim::Skin skin_of(const BodySpec& body) {
  return std::visit([&](const auto& kind) { return kind.skin(body); }, body.kind);
}

BodyRows rows_of(const BodySpec& body, StripOrder order) {
  return std::visit([&](const auto& kind) { return kind.rows(body, order); }, body.kind);
}

bool takes_spectrum(const BodySpec& body) {
  return std::visit([](const auto& kind) { return kind.takes_spectrum(); }, body.kind);
}

const sim::Mesh& particle_mesh(const BodySpec& body) {
  return std::visit([&](const auto& kind) -> const sim::Mesh& { return kind.particle_mesh(body); }, body.kind);
}

std::optional<double> most_strain(const BodySpec& body) {
  return std::visit([](const auto& kind) { return kind.most_strain(); }, body.kind);
}

ContactSpec contact_by_kind(const BodySpec& body) {
  return std::visit([](const auto& kind) { return kind.contact_by_kind(); }, body.kind);
}

sim::Mesh touching_mesh(const BodySpec& body) {
  return std::visit([&](const auto& kind) { return kind.touching_mesh(body); }, body.kind);
}

}  // namespace billow::cli
