// "-D key.path=value": changes to a tree before anything in it is checked.
#pragma once

#include <string>
#include <vector>

#include "cli/yaml/yaml_tree.h"

namespace billow::cli {

/// A `-D key.path=value` from the command line, or an entry of a study's `set`.
struct Override {
  std::string path;        // e.g. "solver.filter.lambda", "bodies.0.cloth.mass" or "bodies.drape.cloth.mass"
  std::string value;       // YAML
  NodePtr node = nullptr;  // the value where it has been read already; `value` then says the same
  std::string where = {};  // its place in a file; empty: "-D PATH"
};

/// The tree with the overrides applied in order; `root` itself stays as it is. Maps on the way that do not exist are
/// made; an entry of a list is named by its index from 0, or by the value of its key `name`. Throws InputError
/// "-D PATH: …", or with the override's own place, where a path leads nowhere or a value is no YAML. Whether a key is
/// known is left to the reader.
NodePtr with_overrides(const NodePtr& root, const std::vector<Override>& overrides);

/// Adds `-D PATH=VALUE` for each to the words of a command.
void add_overrides(const std::vector<Override>& overrides, std::vector<std::string>& words);

}  // namespace billow::cli
