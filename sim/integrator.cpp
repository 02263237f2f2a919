// The catalogue of time-integration schemes.
#include "sim/integrator.h"

#include <array>
#include <numbers>

#include "sim/schemes.h"

namespace billow::sim {

std::string_view name(Method method) {
  constexpr std::array<std::string_view, 6> names = {"forward_euler", "fb_euler",       "verlet",
                                                     "rk4",           "backward_euler", "imex"};
  return names[static_cast<std::size_t>(method)];
}

std::unique_ptr<Integrator> make_integrator(Method method, const IntegratorOptions& options) {
  switch (method) {
    case Method::forward_euler:
      return make_forward_euler();
    case Method::fb_euler:
      return make_forward_backward_euler();
    case Method::verlet:
      return make_verlet();
    case Method::rk4:
      return make_runge_kutta_4();
    case Method::backward_euler:
      return make_backward_euler(options);
    case Method::imex:
      return make_imex(options);
  }
  return nullptr;
}

bool is_explicit(Method method) { return method != Method::backward_euler && method != Method::imex; }

std::optional<double> paper_limit(Method method) {
  if (!is_explicit(method)) return std::nullopt;
  return method == Method::rk4 ? 2.0 * std::numbers::sqrt2 : 2.0;
}

}  // namespace billow::sim
