// What becomes of the springs' sum on a particle. The vector passes have the same in spring_arithmetic-inl.h, bit for
// bit.
#pragma once

#include <cstddef>

namespace billow::sim {

/// Where a spring pass puts the sum s of a particle's springs; columns have one entry per particle. Without `mass`:
/// out = s. With it, f = s - friction v + m g + applied: out = f without `inverse_mass`, else a = M^-1 f without
/// `base`, else base + step a.
struct SpringSink {
  double* out[3] = {};
  const double *mass = nullptr, *inverse_mass = nullptr;  // [kg], [1/kg]; null: none
  const double* velocity[3] = {};                         // [m/s]
  double friction = 0.0;                                  // [kg/s]
  double gravity[3] = {};                                 // [m/s^2]
  const double* applied[3] = {};                          // [N] forces that are not springs'; null: none
  const double* base[3] = {};                             // null: none
  double step = 0.0;                                      // [s]

  /// The same, its columns beginning at `particle`.
  SpringSink from(std::ptrdiff_t particle) const {
    SpringSink moved = *this;
    const auto move = [particle](auto*& column) {
      if (column) column += particle;
    };
    for (int axis = 0; axis < 3; ++axis)
      move(moved.out[axis]), move(moved.velocity[axis]), move(moved.applied[axis]), move(moved.base[axis]);
    move(moved.mass), move(moved.inverse_mass);
    return moved;
  }

  void put(int axis, std::ptrdiff_t i, double sum) const {
    if (!mass) {
      out[axis][i] = sum;
      return;
    }
    if (friction != 0.0) sum -= friction * velocity[axis][i];
    if (gravity[axis] != 0.0) sum += gravity[axis] * mass[i];
    if (applied[axis]) sum += applied[axis][i];
    if (inverse_mass) sum *= inverse_mass[i];
    out[axis][i] = base[axis] ? base[axis][i] + step * sum : sum;
  }
};

}  // namespace billow::sim
