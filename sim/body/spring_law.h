// How hard one spring pulls at a given length: the laws of the spring models, without direction.
#pragma once

#include "sim/body/structure.h"

namespace billow::sim {

/// Tension T(l) [N] (positive pulls the ends together) and its slope dT/dl [N/m] at one length.
struct Tension {
  double force = 0.0;
  double slope = 0.0;
};

/// Linear: T = k (l - L).
inline Tension linear_tension(double length, double rest_length, double stiffness) {
  return {stiffness * (length - rest_length), stiffness};
}
/// Its energy [J].
double linear_energy(double length, double rest_length, double stiffness);

/// Choi & Ko 2002, sequential connections: T = k (l - L) when stretched, 0 when compressed.
inline Tension stretch_tension(double length, double rest_length, double stiffness) {
  return length >= rest_length ? linear_tension(length, rest_length, stiffness) : Tension{};
}

/// Choi & Ko 2002, interlaced connections: a beam of length L that buckles into an arc with chord l. With
/// A = sinc^-1(l / L): f_b = (4 k_b / L^2) A^2 / (cos A - sin A / A), T = max(f_b, c_b (l - L)) for l < L, else 0.
/// `rigidity` is k_b [N m^2], `stiffness` c_b [N/m].
Tension buckling_tension(double length, double rest_length, double stiffness, double rigidity);
/// Its energy: 1/2 c_b (l - L)^2 where the straight branch holds, 1/2 k_b L kappa^2 with kappa = 2 A / L where the beam
/// is buckled, shifted to be continuous.
double buckling_energy(double length, double rest_length, double stiffness, double rigidity);

/// The steepest slope dT/dl [N/m] of buckling_tension over all lengths: c_b, or that of the most buckled beam.
double steepest_buckling_slope(double rest_length, double stiffness, double rigidity);

/// A in (0, pi) with sin(A) / A = ratio, for 0 < ratio < 1; exact to rounding. 0 for ratio >= 1, pi for ratio <= 0.
double inverse_sinc(double ratio);

/// True for the connections that carry bending in the choi_ko model.
inline bool is_interlaced(SpringKind kind) { return kind == SpringKind::bend; }

/// The law of `body` for a spring of `kind`, and its energy [J].
Tension tension(const Body& body, SpringKind kind, double length, double rest_length, double stiffness);
double spring_energy(const Body& body, SpringKind kind, double length, double rest_length, double stiffness);

/// Its steepest slope [N/m] over all lengths.
double steepest_slope(const Body& body, SpringKind kind, double rest_length, double stiffness);

}  // namespace billow::sim
