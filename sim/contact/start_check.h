// Whether surfaces are apart before anything moves: nothing can be kept apart that is not.
#pragma once

#include "base/error.h"
#include "sim/contact/contact_surface.h"

namespace billow::sim {

/// What a body is in the way of before anything moves.
struct StartError : InputError {
  StartError(const std::string& text, int the_body) : InputError(text), body(the_body) {}
  int body;  // its place in the structure
};

/// Throws StartError where triangles of `surface` at `x` (N) [m] cross, naming the bodies, how many pairs of faces
/// cross and the first of them; and where vertices lie inside something rounded.
void check_apart(const ContactSurface& surface, const Points& x);

}  // namespace billow::sim
