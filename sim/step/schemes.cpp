// The table.
#include "sim/step/schemes.h"

#include <numbers>

namespace billow::sim {

namespace {

// 2 for the Euler kind and Verlet is the paper's equation 11; RK4's 2 sqrt 2 is what its sqrt 8.75 is close to.
constexpr double euler = 2.0, runge_kutta = 2.0 * std::numbers::sqrt2;

constexpr Scheme table[] = {
    // method, name, order, evaluations, explicit, omega h, maker
    {Method::forward_euler, "forward_euler", 1, 1, true, euler, make_forward_euler},
    {Method::fb_euler, "fb_euler", 1, 1, true, euler, make_fb_euler},
    {Method::verlet, "verlet", 2, 1, true, euler, make_verlet},
    {Method::rk4, "rk4", 4, 4, true, runge_kutta, make_rk4},
    {Method::backward_euler, "backward_euler", 1, 1, false, std::nullopt, make_backward_euler},
    {Method::imex, "imex", 1, 1, false, std::nullopt, make_imex},
};

}  // namespace

std::span<const Scheme> schemes() { return table; }

const Scheme& scheme(Method method) { return row_for(table, &Scheme::method, method); }

Words<Method> words(Method) {
  static constexpr auto list = words_of(table, &Scheme::name, &Scheme::method);
  return list;
}

Words<LinearSolver> words(LinearSolver) {
  static constexpr Word<LinearSolver> list[] = {{"conjugate_gradient", LinearSolver::conjugate_gradient},
                                                {"cholesky", LinearSolver::cholesky}};
  return list;
}

}  // namespace billow::sim
