// Every key that a scene may have, with the numbers and words it accepts.
#pragma once

#include <string>
#include <vector>

#include "cli/yaml_reader.h"

namespace billow::cli::keys {

extern const Section scene, body, cloth, stiffness, damping, pin, transform, axis_angle, solver, filter, render, camera,
    background, strip, spectrum, soft, soft_stiffness, variation, fish, fish_mass, fish_stiffness, motion, motion_key,
    water;

/// A section and where it stands in a scene, "bodies[].cloth.pins[]" being every entry of a list: what a scene's schema
/// must say as well.
struct PlacedSection {
  std::string path;
  const Section* section;
};
const std::vector<PlacedSection>& all();

}  // namespace billow::cli::keys
