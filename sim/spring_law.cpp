// The spring models' tension and energy.
#include "sim/spring_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace billow::sim {

double linear_energy(double length, double rest_length, double stiffness) {
  const double stretch = length - rest_length;
  return 0.5 * stiffness * stretch * stretch;
}

namespace {

// sin(A)/A, cos(A) - sin(A)/A = -A^2/3 + A^4/30 - A^6/840 and their friends lose all digits near A = 0.
double sinc(double a) { return a < 1e-4 ? 1.0 - a * a / 6.0 : std::sin(a) / a; }

double chord_slope(double a) {  // D(A) = cos A - sin A / A
  const double s = a * a;
  return a < 0.05 ? -s / 3.0 * (1.0 - s / 10.0 * (1.0 - s / 28.0 * (1.0 - s / 54.0))) : std::cos(a) - sinc(a);
}

// T(A) = A^2 / D and dT/dA. Near 0: T = -3 - 3 A^2/10 - ..., from the series of D.
double buckling_number(double a) { return a < 1e-6 ? -3.0 : a * a / chord_slope(a); }

double buckling_number_slope(double a) {
  if (a < 0.02) return -0.6 * a - a * a * a * (27.0 / 350.0);
  const double d = chord_slope(a);
  const double d_slope = -std::sin(a) - d / a;  // d/dA (cos A - sin A / A)
  return (2.0 * a * d - a * a * d_slope) / (d * d);
}

}  // namespace

double inverse_sinc(double ratio) {
  if (ratio >= 1.0) return 0.0;
  if (ratio <= 0.0) return std::numbers::pi;
  // sinc A = 1 - A^2/6 + ... near 0 and 1 - A/pi near pi; this start is within a few percent in between.
  double a = std::numbers::pi * std::sqrt(1.0 - ratio) * (1.0 - (1.0 - std::sqrt(6.0) / std::numbers::pi) * ratio);
  for (int k = 0; k < 8; ++k) {  // Newton on sinc(A) - ratio, derivative D(A) / A
    const double step = (sinc(a) - ratio) * a / chord_slope(a);
    a = std::clamp(a - step, 0.25 * a, 0.5 * (a + std::numbers::pi));
    if (std::abs(step) <= 1e-15 * a) break;
  }
  return a;
}

Tension buckling_tension(double length, double rest_length, double stiffness, double rigidity) {
  if (length >= rest_length) return {};
  const Tension straight = linear_tension(length, rest_length, stiffness);
  const double scale = 4.0 * rigidity / (rest_length * rest_length);
  if (straight.force >= -3.0 * scale) return straight;  // T(A) <= -3: the straight branch holds without looking at A
  const double a = inverse_sinc(length / rest_length);
  const double buckled = scale * buckling_number(a);
  if (straight.force >= buckled) return straight;
  // df/dl = scale T'(A) dA/dl with dA/dl = (A / D) / L
  return {buckled, scale * buckling_number_slope(a) * a / (chord_slope(a) * rest_length)};
}

namespace {

// The length at which the straight branch meets the buckled one: c_b (l - L) = f_b(l). Bisection on their difference,
// which is positive just below L; returns 0 when the straight branch holds down to zero length.
double branch_length(double rest_length, double stiffness, double rigidity) {
  const double scale = 4.0 * rigidity / (rest_length * rest_length);
  const auto straight_holds = [&](double length) {
    return stiffness * (length - rest_length) >= scale * buckling_number(inverse_sinc(length / rest_length));
  };
  double low = 0.0, high = rest_length;
  if (straight_holds(low)) return 0.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (straight_holds(middle) ? high : low) = middle;
  }
  return high;
}

double arc_energy(double length, double rest_length, double rigidity) {
  const double curvature = 2.0 * inverse_sinc(length / rest_length) / rest_length;
  return 0.5 * rigidity * rest_length * curvature * curvature;
}

}  // namespace

double buckling_energy(double length, double rest_length, double stiffness, double rigidity) {
  if (length >= rest_length) return 0.0;
  const double branch = branch_length(rest_length, stiffness, rigidity);
  if (length >= branch) return linear_energy(length, rest_length, stiffness);
  return linear_energy(branch, rest_length, stiffness) + arc_energy(length, rest_length, rigidity) -
         arc_energy(branch, rest_length, rigidity);
}

Tension tension(const Body& body, SpringKind kind, double length, double rest_length, double stiffness) {
  if (body.spring_model == SpringModel::linear) return linear_tension(length, rest_length, stiffness);
  return is_interlaced(kind) ? buckling_tension(length, rest_length, stiffness, body.buckling_rigidity)
                             : stretch_tension(length, rest_length, stiffness);
}

double spring_energy(const Body& body, SpringKind kind, double length, double rest_length, double stiffness) {
  if (body.spring_model == SpringModel::linear) return linear_energy(length, rest_length, stiffness);
  if (is_interlaced(kind)) return buckling_energy(length, rest_length, stiffness, body.buckling_rigidity);
  return length >= rest_length ? linear_energy(length, rest_length, stiffness) : 0.0;
}

}  // namespace billow::sim
