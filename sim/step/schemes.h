// The table of time-integration schemes: a row for each.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "base/words.h"
#include "sim/step/integrator.h"

namespace billow::sim {

enum class Method { forward_euler, fb_euler, verlet, rk4, backward_euler, imex };

/// What is known of a scheme before it runs.
struct Scheme {
  Method method;
  std::string_view name;          // as scenes and reports write it
  int order;                      // of its error in h, for forces that do not depend on the velocity
  int evaluations;                // of the forces, a step
  bool is_explicit;               // its step is bounded by the stiffness
  std::optional<double> omega_h;  // the undamped limit of its literature; none for the implicit schemes
  std::unique_ptr<Integrator> (*make)(const IntegratorOptions& options);
};

/// All of them, in the order in which they are listed.
std::span<const Scheme> schemes();
const Scheme& scheme(Method method);
Words<Method> words(Method);

inline std::string_view name(Method method) { return scheme(method).name; }
inline bool is_explicit(Method method) { return scheme(method).is_explicit; }

// The makers, each in the file of its scheme.
std::unique_ptr<Integrator> make_forward_euler(const IntegratorOptions&);
std::unique_ptr<Integrator> make_fb_euler(const IntegratorOptions&);
std::unique_ptr<Integrator> make_verlet(const IntegratorOptions&);
std::unique_ptr<Integrator> make_rk4(const IntegratorOptions&);
std::unique_ptr<Integrator> make_backward_euler(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_imex(const IntegratorOptions& options);

}  // namespace billow::sim
