// What of a scene's touching surfaces crosses, by exact predicates.
#pragma once

#include "sim/contact/contact.h"
#include "tests/support/intersections.h"

namespace billow::test {

/// Crossings of the triangles of `surface`, whose vertices are at `x` (N) [m]; something rounded has none. Only
/// what contact keeps apart counts: not two colliders, nor a body that may pass through itself.
std::size_t crossings_of(const sim::ContactSurface& surface, const sim::Points& x);

/// The same of bodies and colliders as they are drawn at `state`, something rounded by its mesh, and the particles that
/// lie within half-spaces.
std::size_t crossings_of(const sim::ContactModel& model, const sim::State& state);

}  // namespace billow::test
