// The programs of a pass over the bodies: one for surfaces, one for those with holes.
#pragma once

#include <string>
#include <vector>

#include "render/frame/albedo.h"
#include "render/frame/shaders.h"
#include "render/gl/gl_objects.h"

namespace billow::render {

/// A pass that is compiled twice where a body's texture cuts holes into it. GL must have no other texture unit bound to
/// the one of the albedo while it draws.
class BodyPrograms {
 public:
  BodyPrograms(const Gl& gl, const std::string& name, const std::string& vertex, const std::string& fragment,
               const std::vector<Albedo>& albedos);

  /// Calls `set_up(program)` with each program in use.
  template <class SetUp>
  void set_up(const SetUp& work) const {
    for (const Program& program : programs_) {
      program.use();
      work(program);
    }
  }

  /// The program for a finish, in use, its texture bound to the unit; `unit` is free otherwise.
  const Program& use_for(const Albedo& albedo, GLenum unit) const;

 private:
  const Gl* gl_;
  std::vector<Program> programs_;  // without holes, with
};

}  // namespace billow::render
