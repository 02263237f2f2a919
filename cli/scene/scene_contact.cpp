// contact: in a body, and what touches what in the whole scene.
#include <algorithm>

#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_parts.h"

namespace billow::cli {
namespace {

// Thin enough that a mesh can fold, thick enough that its cloth looks like one.
constexpr double thickest_by_mesh = 0.002;  // [m]
constexpr double share_of_edge = 0.25;

ContactSpec read_touching(MapReader& map, const BodySpec& body) {
  ContactSpec contact = contact_by_kind(body);
  contact.self = map.boolean("self", contact.self);
  contact.thickness = map.number_or_word("thickness", contact.thickness);
  contact.friction = map.number("friction", contact.friction);
  return contact;
}

sim::BodyContact touching(const BodySpec& body) {
  const sim::Mesh mesh = touching_mesh(body);
  const double by_mesh = std::min(thickest_by_mesh, share_of_edge * sim::mean_edge_length(mesh));
  return {.touches = !mesh.face.empty(),
          .self = body.contact->self,
          .thickness = body.contact->thickness.value_or(by_mesh),
          .friction = body.contact->friction,
          .face = mesh.face};
}

}  // namespace

void read_contact(MapReader& body, BodyDraft& draft) {
  const Node* node = body.find("contact");
  if (!node) {
    draft.open_contact = make_scalar("none");
    body.record("contact", draft.open_contact);
    return;
  }
  if (body.is_none("contact")) return;
  MapReader map = body.map_from(node, "contact", keys::section("bodies[].contact"));
  draft.spec.contact = read_touching(map, draft.spec);
}

void settle_contact(std::vector<BodyDraft>& drafts, bool something_to_touch) {
  const auto says_so = [](const BodyDraft& draft) { return draft.spec.contact.has_value(); };
  if (!something_to_touch && std::none_of(drafts.begin(), drafts.end(), says_so)) return;
  for (BodyDraft& draft : drafts) {
    if (!draft.open_contact) continue;
    const NodePtr nothing = make_map(), record = make_map();
    MapReader map(*nothing, keys::section("bodies[].contact"), record);
    draft.spec.contact = read_touching(map, draft.spec);
    *draft.open_contact = *record;
  }
}

std::optional<sim::ContactOptions> contact_of(const Scene& scene, const std::optional<sim::Collider>& ground) {
  sim::ContactOptions contact;
  bool any = false;
  for (const BodySpec& body : scene.bodies) {
    contact.body.push_back(body.contact ? touching(body) : sim::BodyContact{});
    any = any || contact.body.back().touches;
  }
  if (!any) return std::nullopt;
  for (const ColliderSpec& collider : scene.colliders) contact.collider.push_back(collider.solid);
  if (ground) contact.collider.push_back(*ground);
  return contact;
}

}  // namespace billow::cli
