// Products with K and C.
#include "sim/limit/linear_force.h"

namespace billow::sim {

void LinearForce::add_force(const State& state, Eigen::MatrixX3d& force) const {
  linearisation_.stiffness.multiply(state.position, product_);
  force -= product_;
  if (!damped_) return;
  linearisation_.damping.multiply(state.velocity, product_);
  force -= product_;
}

double LinearForce::energy(const State& state) const {
  linearisation_.stiffness.multiply(state.position, product_);
  return 0.5 * state.position.cwiseProduct(product_).sum();
}

void LinearForce::add_linearisation(const State&, double position_weight, double velocity_weight, JacobianForm,
                                    StiffnessMatrix& matrix) const {
  matrix.add_scaled(linearisation_.stiffness, position_weight);
  matrix.add_scaled(linearisation_.damping, velocity_weight);
}

bool LinearForce::add_bound(Shapes, Linearisation& bound) const {
  bound.stiffness.add_scaled(linearisation_.stiffness, 1.0);
  bound.damping.add_scaled(linearisation_.damping, 1.0);
  return true;
}

Forces linear_forces(const Structure& structure, const Linearisation& linearisation) {
  Forces forces(structure);
  forces.add(std::make_unique<LinearForce>(linearisation));
  return forces;
}

}  // namespace billow::sim
