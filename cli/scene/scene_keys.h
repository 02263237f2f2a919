// Every key that a scene may have, with the numbers and words it accepts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/yaml/yaml_reader.h"

namespace billow::cli::keys {

/// A section and where it stands in a scene, "bodies[].cloth.pins[]" being every entry of a list: what a scene's schema
/// must say as well.
struct PlacedSection {
  std::string path;
  const Section* section;
};
const std::vector<PlacedSection>& all();

/// The section that stands at `path`, "" being the scene itself. Throws std::logic_error where there is none.
const Section& section(std::string_view path);

}  // namespace billow::cli::keys
