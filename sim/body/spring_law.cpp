// The spring models' tension and energy.
#include "sim/body/spring_law.h"

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

/// The angles A between which a beam is buckled; both 0 when it never is.
struct BuckledRange {
  double least = 0.0, most = 0.0;
};

// The last angle in (low, high) at which `holds`, which holds at low and fails at high.
template <class Condition>
double last_angle(double low, double high, const Condition& holds) {
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

// As functions of the chord l, f_b is concave (its slope falls from 3 pi^2 to 1.8 times scale / L) and c_b (l - L) is a
// line, so f_b is the larger over one interval at most. The two are farthest apart where their slopes agree. A stiff
// beam never buckles; a soft one stays buckled to zero length; between them the line wins again at short chords.
BuckledRange buckled_range(double rest_length, double stiffness, double rigidity) {
  const double scale = 4.0 * rigidity / (rest_length * rest_length), line = stiffness * rest_length;
  const auto straight_holds = [&](double a) { return line * (sinc(a) - 1.0) >= scale * buckling_number(a); };
  const auto line_is_steeper = [&](double a) {
    return line >= scale * buckling_number_slope(a) * a / chord_slope(a);  // L df_b/dl
  };
  constexpr double pi = std::numbers::pi;
  const double apart = line_is_steeper(pi) ? pi : last_angle(0.0, pi, line_is_steeper);
  if (straight_holds(apart)) return {};
  const double least = last_angle(0.0, apart, straight_holds);
  if (!straight_holds(pi)) return {least, pi};
  return {least, last_angle(apart, pi, [&](double a) { return !straight_holds(a); })};
}

double arc_energy(double a, double rest_length, double rigidity) {
  const double curvature = 2.0 * a / rest_length;
  return 0.5 * rigidity * rest_length * curvature * curvature;
}

}  // namespace

double buckling_energy(double length, double rest_length, double stiffness, double rigidity) {
  if (length >= rest_length) return 0.0;
  const double line = linear_energy(length, rest_length, stiffness);
  if (stiffness * (length - rest_length) >= -12.0 * rigidity / (rest_length * rest_length)) return line;
  const BuckledRange buckled = buckled_range(rest_length, stiffness, rigidity);
  const double a = inverse_sinc(length / rest_length);
  if (a <= buckled.least || buckled.most == 0.0) return line;
  // Along the line to the least angle, then along the arc, then along the line again from the greatest.
  const auto line_energy = [&](double angle) {
    return linear_energy(rest_length * sinc(angle), rest_length, stiffness);
  };
  const double along_arc =
      arc_energy(std::min(a, buckled.most), rest_length, rigidity) - arc_energy(buckled.least, rest_length, rigidity);
  return line_energy(buckled.least) + along_arc + (a > buckled.most ? line - line_energy(buckled.most) : 0.0);
}

// f_b is steeper the more it is bent.
double steepest_buckling_slope(double rest_length, double stiffness, double rigidity) {
  const double a = buckled_range(rest_length, stiffness, rigidity).most;
  if (a == 0.0) return stiffness;
  const double scale = 4.0 * rigidity / (rest_length * rest_length);
  return std::max(stiffness, scale * buckling_number_slope(a) * a / (chord_slope(a) * rest_length));
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

double steepest_slope(const Body& body, SpringKind kind, double rest_length, double stiffness) {
  const bool buckles = body.spring_model == SpringModel::choi_ko && is_interlaced(kind);
  return buckles ? steepest_buckling_slope(rest_length, stiffness, body.buckling_rigidity) : stiffness;
}

}  // namespace billow::sim
