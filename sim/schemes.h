// The makers of the schemes, one per file. make_integrator is how the rest of billow gets one.
#pragma once

#include <memory>

#include "sim/integrator.h"

namespace billow::sim {

std::unique_ptr<Integrator> make_forward_euler();
std::unique_ptr<Integrator> make_forward_backward_euler();
std::unique_ptr<Integrator> make_verlet();
std::unique_ptr<Integrator> make_runge_kutta_4();
std::unique_ptr<Integrator> make_backward_euler(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_imex(const IntegratorOptions& options);

}  // namespace billow::sim
