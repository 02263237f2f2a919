// bodies: in a scene: what every body has, whatever its kind.
#include <fmt/format.h>

#include "base/xml.h"
#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_parts.h"
#include "cli/yaml/colour_text.h"

namespace billow::cli {
namespace {

constexpr std::size_t max_name_length = 64;

const BodyKindRow& kind_of(const MapReader& body) {
  const BodyKindRow* kind = nullptr;
  for (const BodyKindRow& row : body_kinds) {
    if (!body.find(row.key)) continue;
    if (kind)
      fail_at(
          body.where(row.key),
          fmt::format("a body is of one kind, and this one has '{}' and '{}'; make it two bodies", kind->key, row.key));
    kind = &row;
  }
  if (!kind) {
    std::vector<std::string_view> keys;
    for (const BodyKindRow& row : body_kinds) keys.push_back(row.key);
    fail_at(body.where(), fmt::format("a body needs a kind, one of the keys '{}'", fmt::join(keys, "', '")));
  }
  return *kind;
}

}  // namespace

// A name must be usable in -D paths, where an index can stand in its place.
void check_name(const std::string& name, const std::string& where) {
  const bool digits_only = name.find_first_not_of("0123456789") == std::string::npos;
  const bool awkward = name.find_first_of(". \t\r\n=/\\") != std::string::npos;
  if (digits_only || awkward || name.size() > max_name_length)
    fail_at(where, fmt::format("the name '{}' will not do: up to {} characters, no blanks, none of . = / \\, "
                               "and not digits alone",
                               name.substr(0, max_name_length), max_name_length));
  // Caches are called so, and a collection of VTP files names them in XML.
  if (xml_characters(name) != name)
    fail_at(where, "the name holds a control character, or one that stands for none, such as U+FFFE; leave it out");
}

void read_look(MapReader& map, const std::filesystem::path& folder, Look& look) {
  // A colour alone is what the body shall have, whatever its mesh's file says.
  const std::string texture = map.text("texture", find_colour(map, "colour") ? "none" : "mesh");
  look.texture_where = map.where("texture");
  look.of_mesh = texture == "mesh";
  if (texture != "none" && texture != "mesh") look.texture_file = folder / texture;
  look.colour = read_colour(map, "colour", look.colour);
  if (const std::string alpha = map.word("alpha", "auto"); alpha != "auto")
    look.alpha = read_choice<AlphaMode>(*map.find("alpha"), "alpha");
}

BodyDraft read_body(const Node& node, int index, const std::filesystem::path& folder, const NodePtr& record) {
  MapReader map(node, keys::section("bodies[]"), record);
  BodyDraft draft;
  draft.spec.name = map.text("name", fmt::format("body_{}", index));
  check_name(draft.spec.name, map.where("name"));
  kind_of(map).read(map, folder, draft);
  read_contact(map, draft);
  read_look(map, folder, draft.spec);
  return draft;
}

}  // namespace billow::cli
