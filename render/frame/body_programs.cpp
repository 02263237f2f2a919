// Choosing between the programs of a pass.
#include "render/frame/body_programs.h"

#include <algorithm>

namespace billow::render {

BodyPrograms::BodyPrograms(const Gl& gl, const std::string& name, const std::string& vertex,
                           const std::string& fragment, const std::vector<Albedo>& albedos)
    : gl_(&gl) {
  programs_.emplace_back(gl, name, vertex, shaders::headed(fragment, shaders::hole_functions));
  if (std::any_of(albedos.begin(), albedos.end(), [](const Albedo& albedo) { return albedo.has_holes(); }))
    programs_.emplace_back(gl, name + " with holes", vertex,
                           shaders::headed(fragment, "#define HOLES\n" + std::string(shaders::hole_functions)));
}

const Program& BodyPrograms::use_for(const Albedo& albedo, GLenum unit) const {
  const Program& program = programs_[albedo.has_holes() ? 1 : 0];
  program.use();
  if (!albedo.has_holes()) return program;
  bind_texture(*gl_, unit, albedo.texture.name());
  program.set("albedo_map", static_cast<int>(unit));
  program.set("opacity", albedo.opacity);
  program.set("hole_below", albedo.hole_below);
  return program;
}

}  // namespace billow::render
