// Entries -> overrides.
#include "cli/yaml/yaml_changes.h"

#include "cli/yaml/yaml_reader.h"

namespace billow::cli {

std::vector<Override> read_changes(const Node& set) {
  if (set.kind != Node::Kind::map) fail_at(set.where, "set must be a map of scene keys, like {solver.method: rk4}");
  std::vector<Override> changes;
  for (const Entry& entry : set.entries) {
    if (entry.value->kind == Node::Kind::null) fail_at(entry.where, entry.key + " has no value");
    changes.push_back({entry.key, to_yaml_line(*entry.value), entry.value, entry.value->where});
  }
  return changes;
}

}  // namespace billow::cli
