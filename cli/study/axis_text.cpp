// Units come from the scene's keys.
#include "cli/study/axis_text.h"

#include <algorithm>
#include <vector>

#include "cli/scene/scene_keys.h"
#include "cli/text/number_text.h"

namespace billow::cli {

namespace {

std::vector<std::string_view> parts_of(std::string_view path) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    if (end > begin) parts.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// Whether a section's path, such as "bodies[].cloth", is where the first parts of a key lead, and only the key itself
// is left. An entry of a list takes a part of its own: bodies.drape.cloth.
bool leads_to(std::string_view section, const std::vector<std::string_view>& key) {
  std::size_t at = 0;
  for (std::string_view part : parts_of(section)) {
    const bool entries = part.ends_with("[]");
    if (entries) part.remove_suffix(2);
    if (at >= key.size() || key[at] != part) return false;
    at += entries ? 2 : 1;
  }
  return at + 1 == key.size();
}

std::string_view unit_of(std::string_view key) {
  const std::vector<std::string_view> parts = parts_of(key);
  for (const auto& [path, section] : keys::all())
    if (leads_to(path, parts))
      for (const Key& known : section->keys)
        if (known.name == parts.back()) return known.range.unit;
  return {};
}

}  // namespace

std::string default_axis_label(const std::string& name, std::string_view key) {
  const bool lambda = name == "lambda" || key == "lambda" || key.ends_with(".lambda");
  const std::string_view unit = unit_of(key);
  return (lambda ? "λ" : name) + (unit.empty() ? "" : " [" + std::string(unit) + "]");
}

std::string shown_value(const std::string& axis_label, const std::string& value) {
  constexpr std::string_view silent[] = {"true", "false", "none", "auto"};
  const bool is_number = parse_number(value).fault == NumberFault::none;
  if (!is_number && std::find(std::begin(silent), std::end(silent), value) == std::end(silent)) return value;
  const std::size_t bracket = axis_label.rfind(" [");
  const bool has_unit = bracket != std::string::npos && axis_label.ends_with("]");
  const std::string unit = has_unit ? axis_label.substr(bracket + 2, axis_label.size() - bracket - 3) : "";
  const bool is_said = is_number && !unit.empty() && !unit.starts_with("per ");
  return axis_label.substr(0, has_unit ? bracket : axis_label.size()) + " = " + value + (is_said ? " " + unit : "");
}

}  // namespace billow::cli
